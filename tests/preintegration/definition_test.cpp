// Tables of every form against the definition of their entries, on every instruction set; planted faults must fail the
// same comparison.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ostream>
#include <random>

#include "backends/cpu/isa.h"
#include "plugins/estimator/preintegrated/published.h"
#include "tests/preintegration/accuracy.h"
#include "tests/preintegration/media.h"

namespace dvrlab::test {
namespace {
using preintegrated::CellGrid;
using preintegrated::Direction;
using preintegrated::integrate_cells;
using preintegrated::published_table;
using preintegrated::Table;
using preintegrated::table_entries;
using preintegrated::Variant;

constexpr double h = 0.7;

struct Case {
  const char* name;
  RandomMedium what;
  int n;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
// Sizes that are and are not multiples of the lanes, down to the smallest.
const Case cases[] = {{"smooth", {}, 64},
                      {"diracs", {.diracs = 6}, 61},
                      {"rgb", {.rgb = true, .diracs = 3}, 35},
                      {"opaque", {.diracs = 4, .opaque_spikes = true}, 64},
                      {"opaque_rgb", {.rgb = true, .opaque_spikes = true}, 42},
                      {"two", {.diracs = 2}, 2},
                      {"three", {.diracs = 3}, 3},
                      {"nine", {.diracs = 3}, 9}};

class Definition : public testing::TestWithParam<Case> {
 protected:
  Cells cells(std::uint32_t seed) const {
    return integrate_cells(random_medium(seed, GetParam().what), CellGrid{GetParam().n, 0, 1});
  }
};

TEST_P(Definition, TotalBackAndTransmittance) {
  double worst = 0;
  for (std::uint32_t seed : {1u, 2u, 3u}) {
    const Cells c = cells(seed);
    for (const TableRequest& r : {plain_request(GetParam().what.rgb), full_request(GetParam().what.rgb, false)})
      for (const std::string& isa : cpu::usable_isas())
        worst = std::max(worst, worst_error(entries_of(Table(c, r, h, means(isa))), c, r, h));
  }
  std::printf("%s: %.3f of the allowed error\n", GetParam().name, worst);
  EXPECT_LE(worst, 1);
}

TEST_P(Definition, Ratios) {
  double worst = 0;
  for (std::uint32_t seed : {1u, 2u, 3u}) {
    const Cells c = cells(seed);
    const TableRequest r = full_request(GetParam().what.rgb, true);
    const Table table(c, r, h, means());
    worst = std::max(worst, worst_ratio_error(entries_of(table), c, r, h));
    for (int i = 0; i < c.grid.n; ++i) EXPECT_EQ(table.at(i, i, 0), 1.0f);
  }
  std::printf("%s: %.3f of the allowed error\n", GetParam().name, worst);
  EXPECT_LE(worst, 1);
}

// Not a bit differs between instruction sets and numbers of threads, padding included.
TEST_P(Definition, SameBitsOnEveryInstructionSet) {
  const Cells c = cells(4);
  for (const bool ratio : {false, true}) {
    const TableRequest r = full_request(GetParam().what.rgb, ratio);
    const Table first(c, r, h, means("scalar", 1));
    for (const std::string& isa : cpu::usable_isas()) {
      const Table other(c, r, h, means(isa, 3));
      for (Direction d : {Direction::ascending, Direction::descending})
        for (int g = 0; g < r.groups(); ++g)
          EXPECT_EQ(std::memcmp(first.buffer(d, g), other.buffer(d, g), std::size_t(table_entries(c.grid.n)) * 16), 0)
              << isa << " group " << g;
    }
  }
}

TEST_P(Definition, TransmittanceIsSymmetric) {
  const Cells c = cells(5);
  const Table table(c, plain_request(false), h, means());
  for (int i = 0; i < c.grid.n; ++i)
    for (int j = 0; j < i; ++j) {
      const double a = table.at(i, j, 3), b = table.at(j, i, 3);
      EXPECT_NEAR(a, b, 2 * 0x1p-24 * a + 1e-13);
    }
}

// Long slides beside opaque ranges: what one fp64 prefix sum of the depth would lose shows in thin windows of few
// cells.
TEST(LargeTable, SampledEntriesAreRight) {
  const int n = 2048;
  double worst = 0;
  for (std::uint32_t seed : {1u, 2u}) {
    const Cells c = integrate_cells(random_medium(seed, {.diracs = 3, .opaque_spikes = true}), CellGrid{n, 0, 1});
    const TableRequest r = plain_request(false);
    const Table table(c, r, h, means());
    double scale = 0;
    for (int i = 0; i < n; ++i) scale = std::max(scale, defined_entry(c, r.columns[0], 0, h, i, i).C);
    std::mt19937 random(seed);
    for (int k = 0; k < 600; ++k) {
      const int m = int(random() % (k % 2 == 0 ? 12u : 2000u)), lo = int(random() % unsigned(n - m));
      const int i = k % 4 < 2 ? lo : lo + m, j = k % 4 < 2 ? lo + m : lo;
      const double x = defined_entry(c, r.columns[0], 0, h, i, j).C;
      worst = std::max(worst, std::abs(table.at(i, j, 0) - x) / (0x1p-24 * x + 3 * n * 0x1p-53 * scale));
    }
  }
  std::printf("%.3f of the allowed error\n", worst);
  EXPECT_LE(worst, 1);
}

INSTANTIATE_TEST_SUITE_P(Media, Definition, testing::ValuesIn(cases), [](const auto& i) { return i.param.name; });

// ---- negative controls: each must fail the comparison that the builder passes --------------------------------------
EntryOf defined(const Cells& cells, const TableRequest& r, int shift) {
  return [&cells, &r, shift](int i, int j, int o) {
    const bool T = r.outputs[std::size_t(o)].kind == preintegrated::OutputChannel::Kind::transmittance;
    const auto source = T ? SourceColumn{} : r.columns[std::size_t(r.outputs[std::size_t(o)].index)];
    const int last = cells.grid.n - 1;
    const Entry e = defined_entry(cells, source, 0, h, std::min(i + shift, last), std::min(j + shift, last));
    return T ? e.T : e.C;
  };
}

class Negative : public testing::Test {
 protected:
  Cells cells = integrate_cells(random_medium(1, {}), CellGrid{48, 0, 1});
  TableRequest request = plain_request(false);
  double worst(const EntryOf& entry) const {
    const double r = worst_error(entry, cells, request, h);
    std::printf("%.3g times the allowed error\n", r);
    return r;
  }
};

TEST_F(Negative, TheDefinitionItselfPasses) { EXPECT_LE(worst(defined(cells, request, 0)), 1); }
TEST_F(Negative, OffByOneIsFound) { EXPECT_GT(worst(defined(cells, request, 1)), 100); }
// Surface terms that count negative for v1 < v0: transmittances above 1.
TEST_F(Negative, PrintedEquation22IsFound) {
  const auto published = published_table(Table(cells, request, h, means()), Variant::published, 1);
  EXPECT_GT(worst(entries_of(*published)), 100);
}
// Removing the front cell divides by its transmittance: a smooth medium of moderate depth is enough.
TEST_F(Negative, LiteralSlideIsFound) {
  const auto published = published_table(Table(cells, request, h, means()), Variant::published_slide, 1);
  EXPECT_GT(worst(entries_of(*published)), 100);
}

// The variants differ from the table where their faults act, and nowhere else.
TEST(Published, FaultsActWhereTheyAreSaidTo) {
  const Cells smooth = integrate_cells(random_medium(1, {}), CellGrid{24, 0, 1});
  const TableRequest r = plain_request(false);
  const Table table(smooth, r, 1e-3, means());
  const auto printed = published_table(table, Variant::published, 2);
  const auto slid = published_table(table, Variant::published_slide, 2);
  int rising = 0, falling = 0;
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j) {
      (j > i ? rising : falling) += printed->at(i, j, 3) != table.at(i, j, 3) ? 1 : 0;
      EXPECT_NEAR(slid->at(i, i, 0), table.at(i, i, 0), 0);
    }
  EXPECT_EQ(rising, 0);
  EXPECT_EQ(falling, 24 * 23 / 2);
}

TEST_F(Negative, OneWrongBitPatternIsFound) {
  const Table table(cells, request, h, means());
  EXPECT_LE(worst(entries_of(table)), 1);
  EXPECT_GT(
      worst([&](int i, int j, int o) { return table.at(i, j, o) * (i == 40 && j == 3 && o == 2 ? 1 + 1e-6 : 1); }), 1);
}

}  // namespace
}  // namespace dvrlab::test
