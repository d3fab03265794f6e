// A table after an edit of the transfer functions is the table of the edited ones; constant colours and shaded sources
// that equal the extinction (properties P4 and P7 of docs/math, section A).
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "tests/preintegration/accuracy.h"
#include "tests/preintegration/media.h"

namespace dvrlab::test {
namespace {
using namespace preintegrated;

// The medium with everything in [lo, hi] replaced by another one's.
Medium edited(const Medium& a, const Medium& b, double lo, double hi) {
  Medium r;
  const auto cut = [&](const Medium& m, double from, double to) {
    for (MediumInterval i : m.interval) {
      const double x0 = std::max(i.v0, from), x1 = std::min(i.v1, to);
      if (!(x0 < x1)) continue;
      const double t0 = (x0 - i.v0) / (i.v1 - i.v0), d = (x1 - x0) / (i.v1 - i.v0);
      for (auto& p : i.c) p = {p[0] + t0 * (p[1] + t0 * p[2]), d * (p[1] + 2 * p[2] * t0), d * d * p[2]};
      i.v0 = x0;
      i.v1 = x1;
      r.interval.push_back(i);
    }
    for (const Dirac& d : m.dirac)
      if (d.v >= from && d.v < to) r.dirac.push_back(d);
  };
  cut(a, -1, lo);
  cut(b, lo, hi);
  cut(a, hi, 2);
  return r;
}

struct Edit {
  double lo, hi;
};
void PrintTo(const Edit& e, std::ostream* out) { *out << e.lo << " to " << e.hi; }
class Update : public testing::TestWithParam<Edit> {};

TEST_P(Update, EqualsANewTable) {
  double worst = 0;
  for (const bool ratio : {false, true}) {
    const CellGrid grid{75, 0, 1};
    const Medium a = random_medium(21, {.diracs = 4}), b = random_medium(22, {.diracs = 4});
    const Cells before = integrate_cells(a, grid),
                after = integrate_cells(edited(a, b, GetParam().lo, GetParam().hi), grid);
    const TableRequest r = full_request(false, ratio);
    const auto error = ratio ? worst_ratio_error : worst_error;
    Table table(before, r, 0.7, means());
    EXPECT_GT(error(entries_of(table), after, r, 0.7), 100) << "negative control: the edit matters";
    EXPECT_TRUE(table.update(after, means()));
    worst = std::max(worst, error(entries_of(table), after, r, 0.7));
    EXPECT_FALSE(table.update(after, means()));
    EXPECT_TRUE(table.update(before, means()));
    worst = std::max(worst, error(entries_of(table), before, r, 0.7));
  }
  std::printf("%.3f of the allowed error\n", worst);
  EXPECT_LE(worst, 1);
}
INSTANTIATE_TEST_SUITE_P(Edits, Update,
                         testing::Values(Edit{0.5, 0.51}, Edit{0.1, 0.2}, Edit{0.85, 0.9}, Edit{0.3, 0.8},
                                         Edit{0.1, 0.9}));

// Entries between values on one side of the edit stay; where a block recomputes them, to the last bit of a float.
TEST(UpdateTest, LeavesTheOtherEntriesAlone) {
  const CellGrid grid{120, 0, 1};
  const Medium a = random_medium(21, {}), b = random_medium(22, {});
  const Cells before = integrate_cells(a, grid), after = integrate_cells(edited(a, b, 0.5, 0.52), grid);
  const auto range = changed_cells(before, after);
  ASSERT_TRUE(range);
  Table table(before, plain_request(false), 0.7, means());
  const Table old(before, plain_request(false), 0.7, means());
  table.update(after, means());
  const auto below = [&](int i) { return i <= range->first; };
  const auto above = [&](int i) { return i >= range->second; };
  for (int i = 0; i < grid.n; ++i) {
    for (int j = 0; j < grid.n; ++j) {
      if (!(below(i) && below(j)) && !(above(i) && above(j))) continue;
      for (int o = 0; o < 4; ++o) EXPECT_NEAR(table.at(i, j, o), old.at(i, j, o), 0x1p-23 * old.at(i, j, o));
    }
  }
}

// ---- properties
// ------------------------------------------------------------------------------------------------------ A medium whose
// sources are what `of` makes of the extinction, Diracs included.
Medium coloured(Medium m, const Vector3& color) {
  for (MediumInterval& i : m.interval)
    for (int ch = 0; ch < 3; ++ch)
      for (int k = 0; k < 3; ++k) {
        const auto term = [&](Term t) -> double& { return i.c[std::size_t(column(t, ch))][std::size_t(k)]; };
        term(Term::S_l) = color[std::size_t(ch)] * term(Term::tau_l);
        term(Term::S_s) = color[std::size_t(ch)] * term(Term::tau_s);
        term(Term::W_l) = term(Term::tau_l);
        term(Term::W_s) = term(Term::tau_s);
      }
  for (Dirac& d : m.dirac) d.c = color;
  return m;
}

TEST(Properties, ConstantColourIsColourTimesOpacity) {
  for (const bool rgb : {false, true}) {
    const Vector3 color{0.3, 0.9, 1.0};
    const int n = 90;
    const Cells cells = integrate_cells(coloured(random_medium(31, {.rgb = rgb, .diracs = 5}), color), {n, 0, 1});
    const TableRequest r = full_request(rgb, false);  // T, C of S and W, then their back parts
    const Table table(cells, r, 0.9, means());
    const int e = r.extinctions(), S = 3 + e, W = S + 3, back = W + e;
    double worst = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int ch = 0; ch < 3; ++ch) {
          const int own = rgb ? ch : 0;
          const double opacity = 1 - double(table.at(i, j, 3 + own)), c = color[std::size_t(ch)];
          worst = std::max(worst, std::abs(table.at(i, j, S + ch) - c * opacity));  // P4
          worst = std::max(worst, std::abs(table.at(i, j, W + own) - opacity));     // P7: F + B is the total
          worst = std::max(worst, std::abs(table.at(i, j, back + ch) - c * table.at(i, j, back + 3 + own)));
          EXPECT_LE(table.at(i, j, back + ch),
                    table.at(i, j, S + ch) * (1 + 0x1p-22));  // the front part is not negative
        }
    std::printf("worst %.2g\n", worst);
    EXPECT_LE(worst, 2 * 0x1p-24);  // two values of at most 1, rounded to fp32
  }
}

// Without extinction the integrals are those of polynomials.
TEST(Properties, ThinMediaHaveTheirWeightAtTheirCentroid) {
  Medium m;
  m.interval.push_back({0, 1, {}});
  for (int ch = 0; ch < 3; ++ch) m.interval[0].c[std::size_t(column(Term::P, ch))] = {0, 1, 0};  // grows with the value
  TableRequest r;
  r.columns = {{.P = true}};
  r.outputs = {{OutputChannel::Kind::total, 0}, {OutputChannel::Kind::back, 0}, {}, {}};
  const int n = 257;
  const Table table(integrate_cells(m, {n, 0, 1}), r, 1, means());
  // int v0 + w dv dw and int w (v0 + w dv) dw; a cell's own slope is below the table's resolution
  for (int i = 0; i < n; i += 32)
    for (int j = 0; j < n; j += 32) {
      const double v0 = i / 256.0, dv = (j - i) / 256.0;
      EXPECT_NEAR(table.at(i, j, 0), v0 + dv / 2, 1e-7);
      EXPECT_NEAR(table.at(i, j, 1), v0 / 2 + dv / 3, 1.0 / (256 * 32 * 8));
    }
}

}  // namespace
}  // namespace dvrlab::test
