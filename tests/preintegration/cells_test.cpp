// Cells of a medium and the order of a table's entries.
#include "plugins/estimator/preintegrated/cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "framework/interfaces/error.h"
#include "tests/preintegration/accuracy.h"
#include "tests/preintegration/media.h"
#include "tests/support/segment_integral.h"

namespace dvrlab::test {
namespace {
using namespace preintegrated;

// A medium without extinction: its exact segment integral is the integral of the source.
Medium transparent(Medium m, Term source) {
  for (MediumInterval& i : m.interval)
    for (int ch = 0; ch < 3; ++ch) {
      const auto keep = i.c[std::size_t(column(source, ch))];
      for (int t = 0; t < term_count; ++t) i.c[std::size_t(column(static_cast<Term>(t), ch))] = {};
      const bool surface = source == Term::S_s || source == Term::W_s || source == Term::tau_s;
      i.c[std::size_t(column(surface ? Term::S_s : Term::S_l, ch))] = keep;
    }
  return m;
}

TEST(Cells, IntegralsAreExact) {
  double worst = 0;
  for (std::uint32_t seed : {11u, 12u}) {
    const Medium m = random_medium(seed, {.rgb = true});
    const CellGrid grid{37, 0.05, 1.02};  // reaches beyond the nodes on both sides
    const Cells cells = integrate_cells(m, grid);
    for (int t = 0; t < term_count; ++t) {
      const Medium source = transparent(m, static_cast<Term>(t));
      for (int k = 0; k < grid.cells(); ++k) {
        const auto exact = integrate_segment(source, grid.value(k), grid.value(k + 1), 1.0).S;
        for (int ch = 0; ch < 3; ++ch)
          worst =
              std::max(worst, std::abs(cells.integral[std::size_t(column(static_cast<Term>(t), ch))][std::size_t(k)] -
                                       exact[std::size_t(ch)]));
      }
    }
    for (int i = 0; i < grid.n; ++i)
      for (int ch = 0; ch < 3; ++ch)
        EXPECT_NEAR(cells.at_value[std::size_t(column(Term::P, ch))][std::size_t(i)],
                    m.at(grid.value(i))[std::size_t(column(Term::P, ch))], 1e-14);
  }
  std::printf("worst %.2g\n", worst);
  EXPECT_LE(worst, 1e-14);
}

// A cell owns the Diracs in (g_k, g_k+1].
TEST(Cells, DiracsAtGridValuesBelongToTheCellBelow) {
  Medium m;
  for (double v : {0.0, 0.25, 0.3, 1.0, -0.1, 1.1}) m.dirac.push_back({v, {1, 1, 1}, {v, v, v}});
  const Cells cells = integrate_cells(m, {5, 0, 1});
  ASSERT_EQ(cells.dirac.size(), 3u);
  EXPECT_EQ(cells.dirac[0].cell, 0);
  EXPECT_EQ(cells.dirac[0].u, 1);
  EXPECT_EQ(cells.dirac[1].cell, 1);
  EXPECT_NEAR(cells.dirac[1].u, 0.2, 1e-15);
  EXPECT_EQ(cells.dirac[2].cell, 3);
  EXPECT_EQ(cells.dirac[2].u, 1);
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Cells, WhatCannotBeSummedIsRefused) {
  Medium opaque_surface, opaque_interval;
  opaque_surface.dirac.push_back({0.5, {INFINITY, 1, 1}, {1, 1, 1}});
  opaque_interval.interval.push_back({0, 1, {}});
  opaque_interval.interval[0].c[std::size_t(column(Term::tau_l, 1))][0] = INFINITY;
  for (const Medium& m : {opaque_surface, opaque_interval})
    EXPECT_NE(refusal([&] { integrate_cells(m, {16, 0, 1}); }).find("is not finite"), std::string::npos);
  EXPECT_NE(refusal([] { integrate_cells({}, {1, 0, 1}); }).find("at least 2 values"), std::string::npos);
  EXPECT_NE(refusal([] { integrate_cells({}, {16, 1, 1}); }).find("at least 2 values"), std::string::npos);
  EXPECT_EQ(refusal([] { integrate_cells({}, {16, 0, 1}); }), "accepted");
}

TEST(Cells, ChangesAreFoundWhereTheyAre) {
  const CellGrid grid{101, 0, 1};
  Medium m = random_medium(3, {.diracs = 3});
  const Cells before = integrate_cells(m, grid);
  EXPECT_FALSE(changed_cells(before, before));
  Medium edited = m;
  MediumInterval& i = edited.interval[4];
  for (auto& p : i.c) p[0] += 0.1;
  const auto range = changed_cells(before, integrate_cells(edited, grid));
  ASSERT_TRUE(range);
  EXPECT_EQ(range->first, int(i.v0 * 100));
  EXPECT_EQ(range->second, int(i.v1 * 100) + 1);
  edited = m;
  edited.dirac[0].c[1] += 0.5;
  const int cell = int(std::ceil(edited.dirac[0].v * 100)) - 1;
  EXPECT_EQ(changed_cells(before, integrate_cells(edited, grid)), std::pair(cell, cell + 1));
}

// ---- order of the entries
// --------------------------------------------------------------------------------------------
TEST(Layout, EveryEntryHasItsPlaceAndRowsItsCacheLine) {
  for (int n : {2, 3, 4, 5, 8, 13, 64, 101}) {
    for (Direction d : {Direction::ascending, Direction::descending}) {
      std::set<std::int64_t> used;
      for (int i = 0; i < n; ++i) {
        EXPECT_EQ(row_start(n, i) % 4, 0);
        for (int j = d == Direction::ascending ? i : 0; j <= (d == Direction::ascending ? n - 1 : i); ++j) {
          const std::int64_t at = table_entry(d, n, i, j);
          EXPECT_TRUE(at >= 0 && at < table_entries(n) && used.insert(at).second) << n << ": " << i << ", " << j;
        }
      }
      EXPECT_EQ(used.size(), std::size_t(n) * std::size_t(n + 1) / 2);
      EXPECT_LE(table_entries(n) - std::int64_t(used.size()), 3 * n);
    }
  }
  EXPECT_EQ(table_entries(4094) * 16, std::int64_t(128) << 20);  // what table_layout.h says about one page
}

TEST(Layout, PaddingIsZero) {
  const int n = 21;
  const Cells cells = integrate_cells(random_medium(1, {}), {n, 0, 1});
  const Table table(cells, plain_request(false), 1, means());
  for (Direction d : {Direction::ascending, Direction::descending}) {
    const float* entry = table.buffer(d, 0);
    for (int row = 0; row < n; ++row) {
      const std::int64_t end = row == 0 ? table_entries(n) : row_start(n, row - 1);
      for (std::int64_t k = row_start(n, row) + n - row; k < end; ++k)
        for (int c = 0; c < 4; ++c) EXPECT_EQ(entry[k * 4 + c], 0.0f);
    }
  }
}

TEST(Request, WhatIsWrongIsNamed) {
  const Cells cells = integrate_cells(random_medium(1, {}), {8, 0, 1});
  const auto why = [&](const std::function<void(TableRequest&)>& spoil, double h = 1) {
    TableRequest r = plain_request(false);
    spoil(r);
    return refusal([&] { Table(cells, r, h, means()); });
  };
  EXPECT_EQ(why([](auto&) {}), "accepted");
  EXPECT_NE(why([](auto& r) { r.columns.clear(); }).find("1 to 16"), std::string::npos);
  EXPECT_NE(why([](auto& r) { r.outputs.pop_back(); }).find("groups of 4"), std::string::npos);
  EXPECT_NE(why([](auto& r) { r.columns[0].channel = 3; }).find("0, 1 and 2"), std::string::npos);
  EXPECT_NE(why([](auto& r) { r.outputs[1].index = 3; }).find("source column 3; there are 3"), std::string::npos);
  EXPECT_NE(why([](auto& r) { r.outputs[3].index = 1; }).find("extinction 1; there are 1"), std::string::npos);
  EXPECT_NE(why([](auto& r) { r.ratio = true; }).find("no transmittance"), std::string::npos);
  EXPECT_NE(why([](auto&) {}, 0).find("length"), std::string::npos);
  EXPECT_NE(why([](auto&) {}, NAN).find("length"), std::string::npos);
}

}  // namespace
}  // namespace dvrlab::test
