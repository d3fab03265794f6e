// The power series and the methods it is measured against (Lee and Shin 2013): golden values, error bounds of docs/math
// B.6 and G.3 on random media, and what the paper prints wrongly.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/support/segment_integral.h"
#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

double digits(const json& text) { return std::stod(text.get<std::string>()); }

const Target fp64{"cpu fp64", {{"type", "cpu"}}};

class PowerSeries : public GoldenOnTarget {
 protected:
  FrameImage image(json config, const json& estimator) {
    config["estimator"] = estimator;
    if (estimator["type"] != "exact") config["optical_model"].erase("tf");
    return render(config, GetParam()).image;
  }
};

FrameImage image64(json config, const json& estimator) {
  config["estimator"] = estimator;
  config["precision"] = "fp64";
  return render(config, fp64).image;
}

struct Golden {
  json estimator;
  const char *radiance, *transmittance;
};

// The continuous tables of the golden file against 65536 bins: the remaining error is a bin's.
TEST_P(PowerSeries, IsGolden) {
  const json g = golden_case("est_absem_down");
  const auto series = [](int order) {
    return json{{"type", "power_series"}, {"order", order}, {"fallback", "none"}, {"table_size", 65536}};
  };
  const std::vector<Golden> methods = {{series(1), "PS1_C", "T"},
                                       {series(2), "PS2_C", "T"},
                                       {series(3), "PS3_C", "T"},
                                       {{{"type", "engel_1d"}, {"table_size", 65536}}, "engel1d_C", "engel1d_T"},
                                       {{{"type", "kye_1d"}, {"table_size", 65536}}, "kye1d_C", "kye1d_T"}};
  for (const Golden& m : methods) {
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage r = image(golden_config(g, 1), m.estimator);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(double(r.color[c]), digits(g["expect"][m.radiance][c]), 3e-6) << m.estimator.dump();
        EXPECT_NEAR(double(r.trans[c]), digits(g["expect"][m.transmittance][c]), 2e-6) << m.estimator.dump();
      }
    })
  }
}

// Order 1 is the approximative scheme, surfaces included (docs/math B.6).
TEST_P(PowerSeries, OrderOneIsApproximative) {
  for (const char* id : {"est_absem_down", "est_hybrid_up"}) {
    json g = golden_case(id);
    g["params"].erase("diracs");  // the power series cuts there
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage a = image(golden_config(g, 3), {{"type", "approximative"}, {"shading", "constant"}});
      const FrameImage b = image(golden_config(g, 3), {{"type", "power_series"}, {"shading", "constant"}});
      EXPECT_LE(largest_difference(a, b), 1e-6) << id;
      const FrameImage c = image(golden_config(g, 3), {{"type", "power_series"}, {"order", 1}, {"table_size", 32}});
      EXPECT_GT(largest_difference(a, c), 1e-5) << "negative control: coarse tables";
    })
  }
}

// Table G.1 on the ramp: twice the error of the table at the most, where fp32 does not end it, and the orders.
TEST_P(PowerSeries, OrdersOnTheRamp) {
  struct Row {
    int order;
    double at_4, at_16, least_ratio;
  };
  for (const Row& row : {Row{1, 1.0e-2, 6.6e-4, 12}, Row{2, 8.3e-3, 7.5e-5, 50}, Row{3, 1.8e-3, 5.2e-6, 100}}) {
    for (bool backwards : {false, true}) {
      SKIP_WHEN_NOT_SUPPORTED({
        const json estimator = {{"type", "power_series"}, {"order", row.order}, {"fallback", "none"}};
        const FrameImage truth = image(golden_medium_config("ramp", 1, backwards), {{"type", "exact"}});
        const double a = largest_difference(image(golden_medium_config("ramp", 4, backwards), estimator), truth);
        const double b = largest_difference(image(golden_medium_config("ramp", 16, backwards), estimator), truth);
        std::printf("order %d: %.2e at N = 4 (table %.1e), %.2e at 16 (%.1e)\n", row.order, a, row.at_4, b, row.at_16);
        const double times = backwards ? 5 : 2;  // the table's rays run upwards
        EXPECT_LE(a, times * row.at_4);
        EXPECT_LE(b, times * row.at_16);
        EXPECT_GE(a / b, row.least_ratio);
      })
    }
  }
}

// P4 and G.4: with one colour every order is exact at any depth, and so is a split.
TEST_P(PowerSeries, OneColourIsExact) {
  for (const char* medium : {"peak", "box"}) {
    json config = golden_medium_config(medium, 5, false);
    config["optical_model"]["color"] = {{0, 0.9, 0.4, 0.2}};
    for (int order : {1, 2, 3, 4}) {
      SKIP_WHEN_NOT_SUPPORTED({
        const FrameImage r = image(config, {{"type", "power_series"}, {"order", order}});
        const double color[3] = {0.9, 0.4, 0.2};
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(r.color[c], color[c] * (1 - r.trans[c]), 4e-6) << medium << order;
      })
    }
  }
}

// ---- random media against the exact integral, in fp64: the bounds of docs/math B.6
// ------------------------------------------------

constexpr int steps = 16;  // of the transfer functions, and bins of the tables: no error but the series' own

/// Constant between multiples of 1/16: n pairs of nodes.
json stairs(const std::vector<std::array<double, 3>>& value, bool grey) {
  json nodes = json::array();
  for (int k = 0; k < steps; ++k) {
    const auto& x = value[std::size_t(k)];
    for (int end : {k, k + 1})
      nodes.push_back(grey ? json{double(end) / steps, x[0]} : json{double(end) / steps, x[0], x[1], x[2]});
  }
  return nodes;
}

struct RandomSegment {
  json config;
  std::vector<std::array<double, 3>> tau, color;
  double v0, v1, length;
  /// Depth and range of the colours inside.
  double depth() const {
    double sum = 0;
    each([&](int k, double share) { sum += share * length * tau[std::size_t(k)][0]; });
    return sum;
  }
  double oscillation(std::size_t c) const {
    double lo = 1e9, hi = 0;
    each([&](int k, double) {
      if (tau[std::size_t(k)][0] == 0) return;
      lo = std::min(lo, color[std::size_t(k)][c]);
      hi = std::max(hi, color[std::size_t(k)][c]);
    });
    return std::max(hi - lo, 0.0);
  }
  template <class Visit>
  void each(Visit visit) const {
    const double a = std::min(v0, v1) * steps, b = std::max(v0, v1) * steps;
    for (int k = 0; k < steps; ++k) {
      const double part = std::min(b, k + 1.0) - std::max(a, double(k));
      if (part > 0) visit(k, part / (b - a));
    }
  }
};

RandomSegment random_segment(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  RandomSegment s;
  s.tau.resize(steps);
  s.color.resize(steps);
  const bool sparse = uniform(random) < 0.5;
  for (int k = 0; k < steps; ++k) {
    const double tau = sparse && uniform(random) < 0.8 ? 0 : uniform(random);
    s.tau[std::size_t(k)] = {tau, tau, tau};
    s.color[std::size_t(k)] = {uniform(random), uniform(random), uniform(random)};
  }
  s.v0 = uniform(random);
  s.v1 = uniform(random) < 0.3 ? s.v0 + (uniform(random) - 0.5) * 0.1 : uniform(random);
  s.v1 = std::clamp(s.v1, 0.0, 1.0);
  s.length = std::pow(10.0, -2 + 3.3 * uniform(random));
  s.config = ray_config(ramp_field(s.v0, s.v1, s.length), s.length, s.length);
  s.config["data"]["bounds"] = {{-64, -64, -64}, {64, 64, 64}};
  s.config["optical_model"] = {{"type", "absorption_emission"},
                               {"tf", "nodes"},
                               {"tf_range", {0, 1}},
                               {"extinction", stairs(s.tau, true)},
                               {"color", stairs(s.color, false)}};
  return s;
}

/// The same as a medium, for the integral that is independent of the framework's kernels.
Medium medium_of(const RandomSegment& s) {
  Medium m;
  for (std::size_t k = 0; k < s.tau.size(); ++k) {
    MediumInterval i{double(k) / steps, double(k + 1) / steps, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      i.c[std::size_t(column(Term::tau_l, int(c)))] = {s.tau[k][c], 0, 0};
      i.c[std::size_t(column(Term::P, int(c)))] = {s.tau[k][c] * s.color[k][c], 0, 0};
    }
    m.interval.push_back(i);
  }
  return m;
}

// 10,000 media: every order stays inside its bound at every depth it is safe for, order 1 at every depth at all.
TEST(PowerSeriesBounds, RandomMedia) {
  std::mt19937 random(2013);
  int judged[5] = {}, above_order_one = 0;
  double worst[5] = {};
  for (int trial = 0; trial < 10000; ++trial) {
    const RandomSegment s = random_segment(random);
    const int order = 1 + trial % 4;
    const FrameImage r =
        image64(s.config, {{"type", "power_series"}, {"order", order}, {"fallback", "none"}, {"table_size", steps}});
    const SegmentIntegral truth = integrate_segment(medium_of(s), s.v0, s.v1, s.length);
    const double M = s.depth();
    const double safe[] = {0, 1e9, 0.5, 1, 1}, factor[] = {0, 0.125, 0.08, 0.025, 0.006};
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(r.transmittance(c), truth.T[c], 1e-12) << "trial " << trial;
      if (M > safe[order]) continue;
      const double bound =
          order == 1 ? std::min(M * M / 8, 1.0) * s.oscillation(c) : factor[order] * std::pow(M, order + 1);
      const double error = std::abs(r.radiance(c) - truth.P[c]);
      ASSERT_LE(error, bound + 1e-12) << "order " << order << ", depth " << M << ", trial " << trial << s.config.dump();
      if (bound > 1e-9) worst[order] = std::max(worst[order], error / bound);
      ++judged[order];
    }
    // Negative control: beyond the safe depth the bound of order 1 does not hold for the higher orders.
    if (order > 1 && M > 2)
      for (std::size_t c = 0; c < 3; ++c)
        above_order_one += std::abs(r.radiance(c) - truth.P[c]) > std::min(M * M / 8, 1.0) * s.oscillation(c);
  }
  for (int order = 1; order <= 4; ++order) {
    std::printf("order %d: %d radiances, worst error %.2f of the bound\n", order, judged[order], worst[order]);
    EXPECT_GT(judged[order], 1000);
    EXPECT_GT(worst[order], 0.05) << "the bound says something";
  }
  EXPECT_GT(above_order_one, 100);
}

// A ray: what the segments' bounds leave of it, (1 + M) M osc / 8 of the worst segment (docs/math G).
TEST(PowerSeriesBounds, Rays) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0;
  int above_segment = 0;
  for (int trial = 0; trial < 400; ++trial) {
    RandomSegment s = random_segment(random);
    const double omega = 0.5 + 3 * uniform(random), phi = 6 * uniform(random), length = 3;
    const int segments = 2 + trial % 23;
    const double step = length / segments;
    s.length = step;
    const double deep = std::pow(10.0, 1.5 * uniform(random) - 1);
    for (auto& tau : s.tau)
      for (double& x : tau) x *= deep / step;
    json config = s.config;
    config["data"] = ray_config(
        {{"field", "sinusoid"}, {"direction", {1, 0, 0}}, {"a", 0.5}, {"b", 0.49}, {"omega", omega}, {"phi", phi}},
        length, step)["data"];
    config["camera"]["t"] = {0, length};
    config["sampling"]["step"] = step;
    config["optical_model"]["extinction"] = stairs(s.tau, true);
    double bound = 0;
    for (int k = 0; k < segments; ++k) {
      s.v0 = 0.5 + 0.49 * std::sin(omega * k * step + phi);
      s.v1 = 0.5 + 0.49 * std::sin(omega * (k + 1) * step + phi);
      const double M = s.depth();
      for (std::size_t c = 0; c < 3; ++c) bound = std::max(bound, (1 + M) * M * s.oscillation(c) / 8);
    }
    const FrameImage truth = image64(config, {{"type", "exact"}});
    const FrameImage r = image64(config, {{"type", "power_series"}, {"table_size", steps}});
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::abs(r.radiance(c) - truth.radiance(c));
      ASSERT_LE(error, bound + 1e-9) << trial << config.dump();
      if (bound > 1e-6) worst = std::max(worst, error / bound);
      above_segment += error > bound / 20;
    }
  }
  std::printf("rays: worst error %.2f of the bound\n", worst);
  EXPECT_GT(worst, 0.1) << "the bound says something";
  EXPECT_GT(above_segment, 20);
}

// The fallbacks: a split keeps the higher orders' accuracy in deep slabs, order 1 its own bound.
TEST(PowerSeriesBounds, FallbacksInDeepSlabs) {
  std::mt19937 random(7);
  double sum_split = 0, sum_one = 0, sum_none = 0;
  for (int trial = 0; trial < 300; ++trial) {
    RandomSegment s = random_segment(random);
    const double M = s.depth();
    if (M < 1.5 || M > 12) continue;
    const FrameImage truth = image64(s.config, {{"type", "exact"}});
    const auto error = [&](const char* fallback, int order) {
      json estimator = {{"type", "power_series"}, {"order", order}, {"fallback", fallback}, {"table_size", steps}};
      if (fallback == std::string("split")) estimator["most_parts"] = 64;
      const FrameImage r = image64(s.config, estimator);
      double e = 0;
      for (std::size_t c = 0; c < 3; ++c) e = std::max(e, std::abs(r.radiance(c) - truth.radiance(c)));
      return e;
    };
    for (int order : {2, 3, 4}) {
      EXPECT_NEAR(error("order1", order), error("none", 1), 1e-12) << "too deep for any higher order";
      sum_split += error("split", order);
      sum_one += error("order1", order);
      sum_none += std::min(error("none", order), 10.0);
    }
  }
  std::printf("mean errors in proportion: split 1, order 1 %.1f, none %.1f\n", sum_one / sum_split,
              sum_none / sum_split);
  EXPECT_LT(4 * sum_split, sum_one);
  EXPECT_LT(sum_one, sum_none);
}

// What light does not change (emission, particles without an illumination of their own) counts once, whatever the
// light's degree.
TEST_P(PowerSeries, UnlitTermsCountOnce) {
  json config = ray_config(ramp_field(0, 1, 1), 1, 1);
  config["illumination"] = {
      {{"type", "prescribed"}, {"m0", {1, 0.5, 1}}, {"m1", {0.2, 1, 1}}, {"k0", {1, 0.3, 0.5}}, {"k1", {0.4, 1, 1}}}};
  const json shaded = {{"type", "absorption_emission"},
                       {"shaded", true},
                       {"tf", "nodes"},
                       {"extinction", {{0, 0.2}, {1, 0.5}}},
                       {"emission", {{0, 0.8, 0.1, 0.3}, {1, 0.1, 0.6, 0.3}}},
                       {"color", {{0, 1, 0.5, 0.2}, {1, 0.3, 0.9, 0.7}}}};
  const json particles = {{"type", "hybrid"},
                          {"tf", "nodes"},
                          {"dv_std", 0.5},
                          {"surface", {{"opacity", {{0, 0}, {0.5, 0.2}, {1, 0}}}}},
                          {"scattering", {{"opacity", {{0, 0.3}, {1, 0.1}}}, {"color", {{0, 1, 0.5, 0.2}}}}}};
  for (const json& model : {shaded, particles}) {
    for (const char* shading : {"constant", "linear", "nonlinear"}) {
      for (int order : {1, 2, 4}) {
        if (order > 1 && model == particles) continue;
        // A GPU compiles a shader for each: there a few will do.
        if (GetParam().backend["type"] != "cpu" && (order == 2 || shading == std::string("constant"))) continue;
        for (bool lit : {true, false}) {
          json c = config;
          c["optical_model"] = model;
          if (!lit) c.erase("illumination");
          SKIP_WHEN_NOT_SUPPORTED({
            const FrameImage truth = image(c, {{"type", "exact"}, {"shading", shading}});
            const FrameImage r = image(c, {{"type", "power_series"}, {"order", order}, {"shading", shading}});
            const double bounds[] = {0, 0.04, 8e-3, 0, 1e-4};
            EXPECT_LE(largest_difference(r, truth), bounds[order]) << model["type"] << shading << order << lit;
          })
        }
      }
    }
  }
}

// ---- what the paper prints ------------------------------------------------------------------------------------------

// The pseudo-code pairs the colour of a bin with the extinction of the bin below: a red spike in a thin blue medium
// comes out blue, whichever way it is passed.
TEST_P(PowerSeries, PublishedIndexIsOffByOne) {
  for (bool backwards : {false, true}) {
    json config = ray_config(ramp_field(backwards ? 1 : 0, backwards ? 0 : 1, 1), 1, 1.0 / 7);
    const double a = 511.0 / 1024, b = 512.0 / 1024;
    config["optical_model"] = {{"type", "absorption_emission"},
                               {"tf_range", {0, 1}},
                               {"tf_entries", 1025},
                               {"extinction", {{0, 1e-6}, {a, 1e-6}, {a, 2000}, {b, 2000}, {b, 1e-6}}},
                               {"color", {{0, 0, 0, 1}, {a, 0, 0, 1}, {a, 1, 0, 0}, {b, 1, 0, 0}, {b, 0, 0, 1}}}};
    SKIP_WHEN_NOT_SUPPORTED({
      const json right = {{"type", "power_series"}, {"table_size", 1024}};
      json published = right;
      published["variant"] = "published";
      config["estimator"] = right;
      const FrameImage r = render(config, GetParam()).image;
      config["estimator"] = published;
      const FrameImage p = render(config, GetParam()).image;
      EXPECT_GT(r.color[0], 0.8f);
      EXPECT_LT(r.color[2], 0.01f);
      EXPECT_LT(p.color[0], 0.01f);
      EXPECT_GT(p.color[2], 0.8f);
    })
  }
}

// PC of the paper: a left Riemann sum of the first order, and brighter than its opacity.
TEST_P(PowerSeries, PublishedPostClassification) {
  std::vector<double> e;
  SKIP_WHEN_NOT_SUPPORTED({
    const FrameImage truth = image(golden_medium_config("ramp", 1, false), {{"type", "exact"}});
    for (int n : {16, 32, 64})
      e.push_back(largest_difference(
          image(golden_medium_config("ramp", n, false), {{"type", "direct"}, {"variant", "published"}}), truth));
    std::printf("published post-classification: %.2e %.2e %.2e at N = 16, 32, 64\n", e[0], e[1], e[2]);
    EXPECT_GE(e[0] / e[1], 1.7);
    EXPECT_LE(e[0] / e[1], 2.4);
    // It sees an opaque value where a sample lies, and none between.
    json spike = ray_config(ramp_field(0, 1, 1), 1, 0.25);
    spike["optical_model"] = {{"type", "absorption_emission"}, {"color", {{0, 1, 1, 1}}}};
    for (const auto& [at, seen] : {std::pair{0.4, false}, std::pair{0.48, true}}) {
      spike["optical_model"]["opacity"] = {{at, 0}, {at, 1}, {at + 0.06, 1}, {at + 0.06, 0}};
      const FrameImage r = image(spike, {{"type", "direct"}, {"variant", "published"}});
      EXPECT_EQ(r.trans[0] == 0.0f, seen) << at;
    }
    json one = ray_config(ramp_field(0.5, 0.5, 1), 1, 1);
    one["data"] = {{"type", "procedural"},
                   {"evaluate", "formula"},
                   {"bounds", {{-8, -8, -8}, {8, 8, 8}}},
                   {"field", "constant"},
                   {"value", 0.5}};
    one["optical_model"] = model({{0, 2}}, {{0, 1, 1, 1}});
    const FrameImage bright = image(one, {{"type", "direct"}, {"variant", "published"}});
    EXPECT_NEAR(bright.color[0], 2.0, 1e-5);
    EXPECT_NEAR(bright.trans[0], std::exp(-2.0), 1e-6);
  })
}

// Kye and Engel at another length than the nominal one: the last segment's transmittance is the power of the whole
// one's.
TEST_P(PowerSeries, FixedLengthMethodsRescaleTheLastSegment) {
  json config = golden_medium_config("ramp", 1, false);
  config["sampling"]["step"] = 0.8;  // a whole segment and a quarter of one
  for (const char* type : {"engel_1d", "kye_1d"}) {
    SKIP_WHEN_NOT_SUPPORTED({
      const json estimator = {{"type", type}, {"table_size", 65536}};
      const FrameImage both = image(config, estimator);
      // The short segment alone, as the whole one of its values.
      json whole = config;
      whole["camera"]["t"] = {0, 0.8};
      json rest = config;
      const double slope = 0.9963 - 0.0037;
      rest["data"]["scale"] = slope / 4;  // the values of the last fifth over the nominal length
      rest["data"]["offset"] = 0.0037 + slope * 0.8;
      rest["camera"]["t"] = {0, 0.8};
      const FrameImage first = image(whole, estimator), second = image(rest, estimator);
      for (std::size_t c = 0; c < 3; ++c) {
        const double T = std::pow(double(second.trans[c]), 0.25);
        const double C = second.color[c] * (1 - T) / (1 - second.trans[c]);
        EXPECT_NEAR(both.trans[c], first.trans[c] * T, 2e-6) << type;
        EXPECT_NEAR(both.color[c], first.color[c] + first.trans[c] * C, 4e-6) << type;
      }
    })
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, PowerSeries, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
