// The colour difference in L*u*v* against golden values.
#include <gtest/gtest.h>

#include "framework/interfaces/metric.h"
#include "framework/metric/difference_image.h"
#include "framework/metric/luv.h"
#include "tests/truth/truth_test.h"

namespace dvrlab::test {
namespace {

double number(const json& x) { return x.is_string() ? std::stod(x.get<std::string>()) : x.get<double>(); }
std::array<double, 3> triple(const json& x) { return {number(x[0]), number(x[1]), number(x[2])}; }

const json& golden_case() {
  for (const json& c : golden()["cases"])
    if (c["id"] == "cieluv_deltaE") return c["expect"];
  throw std::runtime_error("cieluv_deltaE");
}

TEST(DeltaE, GoldenColours) {
  if (golden().is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  const json& e = golden_case();
  FrameImage a, b;
  a.width = b.width = static_cast<int>(e["pairs"].size());
  a.height = b.height = 1;
  for (std::size_t k = 0; k < e["pairs"].size(); ++k) {
    const auto x = triple(e["pairs"][k][0]), y = triple(e["pairs"][k][1]);
    const auto luv = luv_of(x, false);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(luv[c], number(e["luv_first"][k][c]), 1e-9);
    EXPECT_NEAR(luv_distance(x, y, false), number(e["deltaE"][k]), 1e-9);
    for (std::size_t c = 0; c < 3; ++c) {
      a.color64.push_back(x[c]);
      b.color64.push_back(y[c]);
      a.trans64.push_back(0.5);
      b.trans64.push_back(0.5);
    }
  }
  a.color.assign(a.color64.begin(), a.color64.end());
  b.color.assign(b.color64.begin(), b.color64.end());
  a.trans.assign(a.color.size(), 0.5f);
  b.trans = a.trans;
  const json values = {{"threshold", 6}, {"space", "display"}};
  const std::vector<Parameter> declared = {
      {"threshold", ParameterType::number, "", "6", "", "", Affects::nothing},
      {"space", ParameterType::choice, "", "\"display\"", "display|linear", "", Affects::nothing}};
  const auto measured =
      registry().get<MetricPlugin>("metric", "delta_e_luv").compare(ParameterSet("m", declared, values), a, b);
  EXPECT_NEAR(measured[0].second, number(e["rms"]), 1e-9);
  EXPECT_NEAR(measured[1].second, number(e["rate6"]), 1e-12);
  EXPECT_NEAR(measured[2].second, number(e["rms"]), 1e-9);
  EXPECT_LE(measured[1].second, std::pow(measured[0].second / 6, 2));
}

// What an eye could not see is grey, the rest has a colour; the scale below begins in grey and ends in red.
TEST(DeltaE, PictureMarksTheJustNoticeable) {
  FrameImage a, b;
  a.width = b.width = 2;
  a.height = b.height = 1;
  a.color = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
  b.color = {0.502f, 0.5f, 0.5f, 0.6f, 0.5f, 0.5f};
  a.trans = b.trans = std::vector<float>(6, 0.0f);
  ASSERT_LT(luv_distance({0.5, 0.5, 0.5}, {0.502, 0.5, 0.5}, false), 1);
  ASSERT_GT(luv_distance({0.5, 0.5, 0.5}, {0.6, 0.5, 0.5}, false), 1);
  const FrameImage d = difference_image(a, b, false);
  EXPECT_EQ(d.width, 2);
  EXPECT_GT(d.height, 1) << "the scale";
  const auto grey = [&](std::size_t pixel) {
    return d.color[3 * pixel] == d.color[3 * pixel + 1] && d.color[3 * pixel] == d.color[3 * pixel + 2];
  };
  EXPECT_TRUE(grey(0));
  EXPECT_FALSE(grey(1));
}

}  // namespace
}  // namespace dvrlab::test
