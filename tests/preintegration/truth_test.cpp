// What tables are good for: rays through the media of docs/math, table G, against exact integrals. Errors are absolute,
// of the largest channel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "tests/preintegration/accuracy.h"
#include "tests/preintegration/lookup.h"
#include "tests/preintegration/media.h"
#include "tests/support/render.h"
#include "tests/support/segment_integral.h"

namespace dvrlab::test {
namespace {
using namespace preintegrated;
using nlohmann::json;

// P and S of three channels, so that every golden medium is covered; `ratio`: the corrected look-up.
TableRequest colours(bool ratio) {
  TableRequest r;
  r.ratio = ratio;
  for (int ch = 0; ch < 3; ++ch) {
    r.columns.push_back({.P = true, .S = true, .channel = ch});
    r.outputs.push_back({OutputChannel::Kind::total, ch});
  }
  r.outputs.push_back(ratio ? OutputChannel{} : OutputChannel{OutputChannel::Kind::transmittance, 0});
  return r;
}

Medium without_extinction(Medium m) {
  for (MediumInterval& i : m.interval)
    for (int ch = 0; ch < 3; ++ch)
      i.c[std::size_t(column(Term::tau_l, ch))] = i.c[std::size_t(column(Term::tau_s, ch))] = {};
  return m;
}

// plain: C and T interpolated; corrected: ratios interpolated, the approximate integral and T exact.
enum class LookUp { plain, corrected, bilinear };

class Rays {
 public:
  explicit Rays(const char* name)
      : medium_(golden_medium(golden().at("media").at(name))), bright_(without_extinction(medium_)) {}

  const Medium& medium() const { return medium_; }

  /// Error of a ray v0 -> v1 of length 1 in N segments.
  double error(int n, int N, LookUp how, double v0, double v1) {
    const Table& table = table_of(n, N, how == LookUp::corrected);
    Vector3 I{}, T{1, 1, 1};
    for (int k = 0; k < N; ++k) {
      const double a = v0 + (v1 - v0) * k / N, b = v0 + (v1 - v0) * (k + 1) / N;
      const SegmentIntegral exact = integrate_segment(medium_, a, b, 1.0 / N);
      const SegmentIntegral bright =
          how == LookUp::corrected ? integrate_segment(bright_, a, b, 1.0 / N) : SegmentIntegral{};
      for (std::size_t ch = 0; ch < 3; ++ch) {
        const auto how_between = how == LookUp::bilinear ? Interpolation::bilinear : Interpolation::triangular;
        double C = look_up(table, a, b, int(ch), how_between), t = exact.T[ch];
        if (how == LookUp::corrected) {
          const double Q = -std::log(t);
          C *= (bright.P[ch] + bright.S[ch]) * (Q > 0 ? -std::expm1(-Q) / Q : 1);
        } else {
          t = look_up(table, a, b, 3, how_between);
        }
        I[ch] += T[ch] * C;
        T[ch] *= t;
      }
    }
    const SegmentIntegral truth = integrate_segment(medium_, v0, v1, 1);
    double worst = 0;
    for (std::size_t ch = 0; ch < 3; ++ch) worst = std::max(worst, std::abs(I[ch] - truth.P[ch] - truth.S[ch]));
    return worst;
  }

  /// Up and down the ramp of table G, moved by `shift`.
  double error(int n, int N, LookUp how, double shift = 0) {
    const double v0 = 0.0037 - shift, v1 = 0.9963 - shift;
    return std::max(error(n, N, how, v0, v1), error(n, N, how, v1, v0));
  }

 private:
  const Table& table_of(int n, int N, bool ratio) {
    if (n != n_ || N != N_ || ratio != ratio_ || !table_)
      table_ = std::make_unique<Table>(integrate_cells(medium_, {n, 0, 1}), colours(ratio), 1.0 / N, means());
    n_ = n;
    N_ = N;
    ratio_ = ratio;
    return *table_;
  }
  Medium medium_, bright_;
  std::unique_ptr<Table> table_;
  int n_ = 0, N_ = 0;
  bool ratio_ = false;
};

#define NEEDS_GOLDEN() \
  if (golden().is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)"

// The truth itself: printed values of 16 digits.
TEST(Truth, SegmentIntegralsAreTheGoldenOnes) {
  NEEDS_GOLDEN();
  int seen = 0;
  for (const json& c : golden().at("cases")) {
    const std::string id = c.at("id");
    if (id.rfind("seg_", 0) != 0 && id != "kraus_short") continue;
    const json& ray = c.at("ray");
    const SegmentIntegral s = integrate_segment(golden_medium(c), ray.at("v0"), ray.at("v1"), ray.at("dl"));
    for (std::size_t ch = 0; ch < 3; ++ch) {
      EXPECT_NEAR(s.P[ch] + s.S[ch], std::stod(c.at("expect").at("I")[ch].get<std::string>()), 1e-12) << id;
      EXPECT_NEAR(s.T[ch], std::stod(c.at("expect").at("T")[ch].get<std::string>()), 1e-12) << id;
    }
    ++seen;
  }
  EXPECT_EQ(seen, 5);
}

// Second order in the width of a cell, whatever the number of segments.
TEST(Truth, FourTimesTheValuesDivideTheErrorBySixteen) {
  NEEDS_GOLDEN();
  struct Row {
    const char* medium;
    int n, N;
  };
  for (const Row& row :
       {Row{"ramp", 64, 1}, Row{"ramp", 64, 16}, Row{"ramp", 64, 64}, Row{"ramp", 256, 4}, Row{"ramp", 256, 64},
        Row{"peak", 256, 1}, Row{"peak", 256, 16}, Row{"peak", 256, 64}, Row{"peak", 1024, 16}}) {
    Rays rays(row.medium);
    // A ray's error depends on where its samples lie between the grid values: the largest of 16 rays has no luck.
    const auto largest = [&](int n) {
      double worst = 0;
      for (int k = 0; k < 16; ++k) worst = std::max(worst, rays.error(n, row.N, LookUp::plain, 0.0037 * k / 16));
      return worst;
    };
    const double coarse = largest(row.n), fine = largest(4 * row.n);
    std::printf("%s, %d segments, n = %d: %.3g, n = %d: %.3g, ratio %.1f\n", row.medium, row.N, row.n, coarse,
                4 * row.n, fine, coarse / fine);
    EXPECT_GE(coarse / fine, 12);
    EXPECT_LE(coarse / fine, 20);
  }
}

// Table G.2 of docs/math: the errors of both look-ups, at most twice of what it states.
TEST(Truth, LookUpsAreAsGoodAsStated) {
  NEEDS_GOLDEN();
  struct Row {
    const char* medium;
    int n;
    double plain, corrected;
  };
  for (const Row& row :
       {Row{"ramp", 256, 5.9e-6, 7.0e-6}, Row{"ramp", 1024, 3.7e-7, 4.7e-7}, Row{"peak", 256, 1.5e-2, 6.1e-3},
        Row{"peak", 1024, 1.1e-3, 5.2e-4}, Row{"peak", 4096, 7e-5, 3.3e-5}, Row{"box", 256, 5.2e-3, 2.1e-4},
        Row{"box", 1024, 2.6e-4, 1.1e-5}, Row{"surfpeak", 256, 4.4e-2, 2.3e-4}, Row{"surfpeak", 1024, 7e-3, 1.7e-5}}) {
    Rays rays(row.medium);
    double plain = 0, corrected = 0;
    for (int N : {16, 64, 256, 1024}) {
      plain = std::max(plain, rays.error(row.n, N, LookUp::plain));
      corrected = std::max(corrected, rays.error(row.n, N, LookUp::corrected));
    }
    std::printf("%s, n = %d: plain %.2g (%.2g), corrected %.2g (%.2g)\n", row.medium, row.n, plain, row.plain,
                corrected, row.corrected);
    EXPECT_LE(plain, 2 * row.plain);
    EXPECT_LE(corrected, 2 * row.corrected);
  }
}

// Negative control: interpolating across the diagonal sees surfaces where the value does not change. A homogeneous ray
// beside the surface has light of the particles alone.
TEST(Truth, BilinearDiagonalIsFound) {
  NEEDS_GOLDEN();
  const int n = 256;
  const double v = (127 + 0.5) / (n - 1);
  Rays rays("surfpeak");
  EXPECT_LE(rays.error(n, 200, LookUp::plain, v, v), 1e-3);
  EXPECT_GT(rays.error(n, 200, LookUp::bilinear, v, v), 0.1);
}

}  // namespace
}  // namespace dvrlab::test
