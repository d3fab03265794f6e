// Formulas against independent values and differences; grids against formulas.
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "plugins/data/procedural/formulas.h"
#include "tests/data/test_data.h"

namespace dvrlab::procedural {
namespace {

using test::load_error;
using test::load_grid;

struct Case {
  const char* name;
  FormulaParams f;
};

std::vector<Case> cases() {
  return {{"constant", {Kind::constant, {{{0.7}}}, {{}}}},
          {"ramp", {Kind::ramp, {{{0.3, -0.2, 0.5, 0.1}}}, {{}}}},
          {"radial", {Kind::radial, {{{0.1, 0.2, -0.3, 0.05}, {0.8}}}, {{}}}},
          {"sphere", {Kind::sphere, {{{0.1, 0.0, 0.2, 0.1}, {0.9, 1 / 0.7}}}, {{}}}},
          {"marschner_lobb", {Kind::marschner_lobb, {{{0.5, -0.4, 0.1, 6}}}, {{}}}},
          {"sinusoid", {Kind::sinusoid, {{{0.6, 0.8, 0.0}, {0.5, 0.42, 1.1, 0.05}}}, {{}}}},
          {"polynomial", {Kind::polynomial, {{{25.0 / 27, -20.0 / 27, 12.0 / 27}}}, {{}}}},
          {"polyline",
           {Kind::polyline, {{{0.6, 0.0, 0.8}}}, {{-0.7, 0.1, 1.0}, {-0.2, 0.6, -0.8}, {0.3, 0.2, 1.6}, {0.8, 1, 0}}}}};
}

Vector3 random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  return {u(random), u(random), u(random)};
}

TEST(Formula, GradientMatchesDifferences) {
  std::mt19937 random(1);
  constexpr double h = 1e-5;
  for (const Case& c : cases()) {
    double worst = 0;
    int kinks = 0;
    for (int n = 0; n < 2000; ++n) {
      const Vector3 x = random_point(random);
      const Vector3 g = gradient(c.f, x);
      for (std::size_t a = 0; a < 3; ++a) {
        Vector3 lo = x, hi = x;
        lo[a] -= h;
        hi[a] += h;
        const double error = std::fabs((value(c.f, hi) - value(c.f, lo)) / (2 * h) - g[a]);
        if (error > 1e-3 && gradient(c.f, lo) != gradient(c.f, hi) && error < 3)
          ++kinks;  // a kink of the field between the two points
        else
          worst = std::max(worst, error);
      }
    }
    // h^2/6 times the third derivative, at most 0.1 (12 pi)^3, plus rounding 1e-16/h
    EXPECT_LT(worst, 5e-6) << c.name;
    EXPECT_LE(kinks, 5) << c.name;
  }
}

TEST(Formula, RangeHoldsAndTouchesTheValues) {
  std::mt19937 random(2);
  for (const Case& c : cases()) {
    for (int box = 0; box < 20; ++box) {
      const Vector3 a = random_point(random), b = random_point(random);
      Vector3 lo, hi;
      for (std::size_t k = 0; k < 3; ++k) std::tie(lo[k], hi[k]) = std::minmax(a[k], b[k]);
      const auto [low, high] = range(c.f, lo, hi);
      double least = 1e9, most = -1e9;
      for (int n = 0; n < 40 * 40 * 40; ++n) {
        const std::array<int, 3> i{n % 40, n / 40 % 40, n / 1600};
        Vector3 x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = std::lerp(lo[k], hi[k], i[k] / 39.0);
        const double v = value(c.f, x);
        least = std::min(least, v);
        most = std::max(most, v);
      }
      EXPECT_GE(least, low - 1e-14) << c.name;
      EXPECT_LE(most, high + 1e-14) << c.name;
      if (c.f.kind == Kind::marschner_lobb) continue;  // its range may be wider
      EXPECT_NEAR(least, low, 0.06) << c.name;
      EXPECT_NEAR(most, high, 0.06) << c.name;
    }
  }
}

// Independent evaluations, from the definitions as the papers write them.
double marschner_lobb_paper(double x, double y, double z, double alpha, double f) {
  const double pi = std::numbers::pi;
  const double rho = std::cos(2 * pi * f * std::cos(pi * std::sqrt(x * x + y * y) / 2));
  return (1 - std::sin(pi * z / 2) + alpha * (1 + rho)) / (2 * (1 + alpha));
}

TEST(Procedural, GridHoldsTheFormulaAtItsPoints) {
  const auto grid = load_grid("procedural", {{"size", {5, 4, 3}}, {"bounds", {{-1, -2, 0}, {1, 1, 4}}}});
  ASSERT_TRUE(grid);
  EXPECT_EQ(test::world(*grid, {0, 0, 0}), (Vector3{-1, -2, 0}));
  EXPECT_EQ(test::world(*grid, {4, 3, 2}), (Vector3{1, 1, 4}));
  EXPECT_EQ(grid->hi, (Vector3{4, 3, 2}));
  EXPECT_DOUBLE_EQ(grid->voxel, 0.5);
  EXPECT_EQ(grid->sha256.size(), 64u);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 5; ++i) {
        const double v = marschner_lobb_paper(-1 + 0.5 * i, -2 + j, 2.0 * k, 0.25, 6);
        EXPECT_NEAR(grid->at(i, j, k), v, 6e-8);  // half an ulp of float below 1
      }
  EXPECT_LE(grid->stored_min, grid->at(0, 0, 0));
}

TEST(Procedural, IntegerTypesSpanTheRange) {
  for (const std::string type : {"uint8", "int8", "uint16", "int16"}) {
    const auto grid = load_grid("procedural", {{"field", "ramp"}, {"voxel_type", type}, {"size", {9, 2, 2}}});
    const double steps = type.ends_with("8") ? 255 : 65535;
    EXPECT_DOUBLE_EQ(grid->stored_max - grid->stored_min, steps) << type;
    EXPECT_DOUBLE_EQ(grid->slope, 2 / steps) << type;
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(grid->slope * grid->at(i, 1, 1) + grid->intercept, -1 + 0.25 * i, 0.5001 * grid->slope) << type;
  }
  const auto clamped = load_grid("procedural", {{"field", "ramp"}, {"voxel_type", "uint8"}, {"range", {-0.5, 1}}});
  EXPECT_TRUE(test::has_note(*clamped, "were clamped"));
  const auto constant = load_grid("procedural", {{"field", "constant"}, {"value", 0.3}, {"voxel_type", "int16"}});
  EXPECT_EQ(constant->slope * constant->at(1, 1, 1) + constant->intercept, 0.3);
}

TEST(Procedural, CellCentresFillTheBounds) {
  const auto grid = load_grid("procedural", {{"field", "ramp"}, {"placement", "cell_centres"}, {"size", {4, 4, 4}}});
  EXPECT_EQ(test::world(*grid, {0, 0, 0}), (Vector3{-0.75, -0.75, -0.75}));
  EXPECT_EQ(test::world(*grid, {3, 3, 3}), (Vector3{0.75, 0.75, 0.75}));
  EXPECT_FLOAT_EQ(static_cast<float>(grid->at(1, 0, 0)), -0.25f);
}

TEST(Procedural, MarchTableIsTheBenchmarksVolume) {
  nlohmann::json p{
      {"field", "march_table"}, {"placement", "cell_centres"}, {"size", {256, 256, 256}}, {"voxel_type", "uint8"}};
  const auto start = std::chrono::steady_clock::now();
  const auto bytes = load_grid("procedural", p);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("256^3 march_table: %.2f s\n", seconds);
  p["voxel_type"] = "float32";
  const auto floats = load_grid("procedural", p);
  EXPECT_EQ(bytes->slope, 1.0 / 255);
  for (const int i : {0, 17, 128, 255})
    for (const int j : {3, 127, 200})
      for (const int k : {1, 90, 128}) {
        const double x = (i + 0.5) / 256 * 2 - 1, y = (j + 0.5) / 256 * 2 - 1, z = (k + 0.5) / 256 * 2 - 1;
        const double s = std::exp(-1.8 * (x * x + y * y + z * z)) +
                         0.12 * std::sin(9 * x) * std::sin(11 * y) * std::sin(7 * z) +
                         0.03 * std::sin(40 * x + 23 * y) * std::sin(31 * z);
        EXPECT_EQ(bytes->at(i, j, k), std::round(255 * std::clamp(s, 0.0, 1.0)));
        EXPECT_EQ(static_cast<float>(floats->at(i, j, k)), static_cast<float>(bytes->at(i, j, k)) / 255.0f);
      }
  EXPECT_NE(load_error("procedural", {{"field", "march_table"}, {"evaluate", "formula"}}), "");
}

TEST(Procedural, FormulaFieldCarriesTheLayout) {
  const auto field = std::dynamic_pointer_cast<const FormulaField>(
      test::load("procedural", {{"field", "polyline"},
                                {"evaluate", "formula"},
                                {"direction", {0, 2, 0}},
                                {"node", {{-1, 0.2}, {0, 0.7}, {0.5, 0.1}}},
                                {"size", {3, 5, 9}}}));
  ASSERT_TRUE(field);
  EXPECT_EQ(field->sampler, "formula");
  EXPECT_EQ(field->lo, (Vector3{-1, -1, -1}));
  EXPECT_DOUBLE_EQ(field->voxel, 0.25);
  EXPECT_DOUBLE_EQ(field->stored_min, 0.1);
  EXPECT_DOUBLE_EQ(field->stored_max, 0.7);
  ASSERT_EQ(field->uniforms.size(), 4u);
  EXPECT_EQ(field->uniforms[0].name, "formula_kind");
  EXPECT_EQ(field->uniforms[0].i, static_cast<int>(Kind::polyline));
  EXPECT_TRUE(field->uniforms[0].constant);
  EXPECT_EQ(field->uniforms[1].i, 3);
  EXPECT_EQ(field->uniforms[2].f, (std::array<double, 4>{0, 1, 0, 0}));
  ASSERT_EQ(field->buffers.size(), 1u);
  ASSERT_EQ(field->buffers[0].count, 3u);
  const auto* node = static_cast<const float*>(field->buffers[0].data.get());
  EXPECT_EQ(node[2], 0.5f);
  EXPECT_EQ(node[6], -1.2f);
  const auto* node64 = static_cast<const double*>(field->buffers[0].data64.get());
  ASSERT_NE(node64, nullptr);
  EXPECT_DOUBLE_EQ(node64[2], 0.5);
  EXPECT_DOUBLE_EQ(node64[6], -1.2);
}

TEST(Procedural, TangleAndSphereMeetTheirDefinitions) {
  const auto tangle = load_grid("procedural", {{"field", "polynomial"}, {"size", {3, 3, 3}}});
  EXPECT_FLOAT_EQ(static_cast<float>(tangle->at(0, 2, 0)), 1.0f);
  EXPECT_FLOAT_EQ(static_cast<float>(tangle->at(1, 1, 1)), 12.0f / 27);
  const auto sphere = load_grid("procedural", {{"field", "sphere"}, {"size", {5, 5, 5}}});
  EXPECT_EQ(sphere->at(2, 2, 2), 1.0);
  EXPECT_EQ(sphere->at(1, 2, 2), 0.5);
  EXPECT_EQ(sphere->at(0, 2, 2), 0.0);
  EXPECT_EQ(sphere->at(0, 0, 0), 0.0);
}

TEST(Procedural, RefusesWithTheKey) {
  const std::vector<std::pair<nlohmann::json, std::string>> bad{
      {{{"bounds", {{0, 0, 0}, {1, 0, 1}}}}, "data.bounds"},
      {{{"bounds", {{0, 0}, {1, 1}}}}, "data.bounds"},
      {{{"field", "ramp"}, {"direction", {0, 0, 0}}}, "data.direction"},
      {{{"field", "polyline"}, {"node", {{0, 1}, {0, 2}}}}, "data.node"},
      {{{"field", "polyline"}, {"node", nullptr}}, "data.node"},
      {{{"voxel_type", "uint8"}, {"range", {1, 1}}}, "data.range"},
      {{{"size", {1, 64, 64}}}, "data.size"}};
  for (const auto& [values, key] : bad) EXPECT_TRUE(load_error("procedural", values).starts_with(key)) << values;
}

}  // namespace
}  // namespace dvrlab::procedural
