// Lee and Shin's tables 1 and 2: what tables take, and how that grows with the number of entries n. `expect` of a
// config judges images; sizes are judged here, and so is the work, for each number that a table holds is computed once.
// Times are the bench's.
#include <cmath>
#include <cstdio>
#include <map>

#include "framework/config/experiment.h"
#include "framework/scene/scene.h"
#include "framework/table_study.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using Sizes = std::map<int, double>;  // bytes by the number of entries

/// The name of the method in the papers' words.
std::string method_of(const nlohmann::json& config) {
  const nlohmann::json& estimator = config["estimator"];
  const std::string type = estimator["type"];
  if (type == "kye_1d") return "PI_1D";
  if (type == "preintegrated") return estimator["lookup"] == "plain" ? "PI_2D" : "PI_2D, corrected";
  if (type != "power_series") return type;
  return "PI_PS(" + estimator["order"].dump() + ")" + (config["precision"] == "fp64" ? ", fp64" : "");
}

/// The sizes of a config's tables; each is built once.
std::map<std::string, Sizes> sizes_of(const std::string& name) {
  const std::string file = std::string(DVRLAB_SOURCE) + "/configs/papers/lee_shin2013/" + name + ".json";
  const Experiment e = plan_experiment(load_document(file, {}), registry());
  FieldCache fields;
  std::map<std::string, Sizes> sizes;
  for (const PlannedCase& c : e.cases) {
    const TableStudy s = study_table(c.resolved, registry(), *fields.load(c.resolved, registry()), 3, 1);
    const int n = c.resolved.config["estimator"]["table_size"];
    sizes[method_of(c.resolved.config)][n] = static_cast<double>(s.bytes);
  }
  return sizes;
}

/// The p of n^p between the smallest and the largest table.
double exponent(const Sizes& sizes) {
  const auto &small = *sizes.begin(), &large = *sizes.rbegin();
  return std::log(large.second / small.second) / std::log(double(large.first) / small.first);
}

struct Growth {
  double at_least, at_most;
};

/// n^2, n, and n log n for the moments of order 3, which are kept on log2 n levels.
const std::map<std::string, Growth>& growths() {
  static const std::map<std::string, Growth> all = {{"PI_2D", {1.95, 2.05}},        {"PI_2D, corrected", {1.95, 2.05}},
                                                    {"PI_1D", {0.95, 1.1}},         {"engel_1d", {0.95, 1.1}},
                                                    {"PI_PS(1)", {0.95, 1.1}},      {"PI_PS(3)", {1.05, 1.2}},
                                                    {"PI_PS(3), fp64", {1.05, 1.2}}};
  return all;
}

void expect_growth(const std::map<std::string, Sizes>& sizes) {
  ASSERT_EQ(sizes.size(), growths().size());
  for (const auto& [method, bytes] : sizes) {
    const double p = exponent(bytes);
    std::printf("%s: exponent %.3f from %d to %d entries\n", method.c_str(), p, bytes.begin()->first,
                bytes.rbegin()->first);
    ASSERT_TRUE(growths().contains(method)) << method;
    EXPECT_GE(p, growths().at(method).at_least) << method;
    EXPECT_LE(p, growths().at(method).at_most) << method;
  }
}

TEST(LeeShinTables, SizesAreThoseOfTable1) {
  const auto sizes = sizes_of("table1");
  expect_growth(sizes);
  // The published precision, four floats an entry, and what our tables have beside it (the page of the config).
  for (const int n : {256, 4096}) {
    const double published = 16.0 * n;
    for (const char* method : {"PI_2D", "PI_2D, corrected"}) {
      EXPECT_GE(sizes.at(method).at(n), published * n) << method;
      EXPECT_LE(sizes.at(method).at(n), published * n * 1.05) << method;
    }
    for (const char* method : {"PI_1D", "engel_1d", "PI_PS(1)"}) {
      EXPECT_GE(sizes.at(method).at(n), 3 * published) << method;
      EXPECT_LE(sizes.at(method).at(n), 3 * published * 1.05) << method;
    }
    EXPECT_NEAR(sizes.at("PI_PS(3), fp64").at(n), 2 * sizes.at("PI_PS(3)").at(n), 64) << "doubles";
    EXPECT_LE(sizes.at("PI_PS(3)").at(n), 3 * published * (std::log2(n) + 2)) << "a sum of each order and level";
  }
}

TEST(LeeShinTables, GrowthIsThatOfTable2) {
  const auto sizes = sizes_of("table2");
  expect_growth(sizes);
  for (const char* method : {"PI_1D", "engel_1d", "PI_PS(1)", "PI_PS(3)"}) EXPECT_EQ(sizes.at(method).size(), 4u);
  const auto ratio = [&](const char* method) { return sizes.at("PI_2D").at(4096) / sizes.at(method).at(4096); };
  std::printf("PI_2D takes %.0f times the bytes of PI_PS(1), %.0f times those of PI_PS(3)\n", ratio("PI_PS(1)"),
              ratio("PI_PS(3)"));
  EXPECT_GE(ratio("PI_PS(1)"), 1000);
  EXPECT_GE(ratio("PI_PS(3)"), 80);
  EXPECT_NEAR(ratio("PI_2D, corrected"), 1, 0.01) << "the look-up is another, the table is not";
}

// The bounds tell the methods apart.
TEST(LeeShinTables, AnotherGrowthIsSeen) {
  const Sizes square = {{256, 1.0}, {4096, 256.0}}, linear = {{256, 1.0}, {4096, 16.0}};
  EXPECT_DOUBLE_EQ(exponent(square), 2);
  EXPECT_DOUBLE_EQ(exponent(linear), 1);
  for (const auto& [method, g] : growths()) {
    const double other = exponent(g.at_least > 1.5 ? linear : square);
    EXPECT_TRUE(other < g.at_least || other > g.at_most) << method;
  }
}

}  // namespace
}  // namespace dvrlab::test
