// Precision fp64 through the real march of the cpu backend: what is left is the estimator's error and rounding of
// double.
#include <cmath>
#include <cstdio>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

const Target cpu{"cpu", {{"type", "cpu"}}};

double error64(const FrameImage& image, const RayIntegral& truth) {
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c)
    worst = std::max({worst, std::abs(image.color64.at(c) - truth.I[c]), std::abs(image.trans64.at(c) - truth.T[c])});
  return worst;
}

/// The error in fp64. The same config in fp32 must be far off: the negative control.
double error_in_fp64(json config, const RayIntegral& truth, double seen) {
  const FrameImage strict = render(config, cpu).image;
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(double(strict.color[c]) - truth.I[c]));
  EXPECT_GT(worst, seen) << "the comparison does not see fp32";
  config["precision"] = "fp64";
  return error64(render(config, cpu).image, truth);
}

// N segments multiply N factors, each within half a ULP: N 2^-53, and the sum of the radiance as much again.
TEST(Fp64, HomogeneousMediumInClosedForm) {
  const double length = 0.7, tau = 4.0;
  RayIntegral truth;
  for (std::size_t c = 0; c < 3; ++c) {
    truth.T[c] = std::exp(-tau * length);
    truth.I[c] = (c == 0 ? 0.82 : 0.34) * (1 - truth.T[c]);
  }
  for (const char* tf : {"nodes", "table"}) {
    for (double step : {0.7, 0.1, 0.013, 0.001}) {
      json config = ray_config({{"field", "constant"}, {"value", 0.6}}, length, step);
      config["optical_model"] = model({{0, tau}}, {{0, 0.82, 0.34, 0.34}});
      config["optical_model"]["tf"] = tf;
      const double e = error_in_fp64(config, truth, 1e-9);
      std::printf("fp64 homogeneous, %s, step %g: error %.2e\n", tf, step, e);
      EXPECT_LE(e, 1e-13) << tf << ", step " << step;
    }
  }
}

TEST(Fp64, ClippingPlanesAndObliqueRays) {
  // A plane across the ray leaves 0.45 of it; the direction is not along an axis.
  const double tau = 1.7, norm = std::sqrt(1 + 0.09 + 0.04);
  json config = ray_config({{"field", "constant"}, {"value", 0.2}}, 0.9, 0.02);
  config["camera"]["direction"] = {1, 0.3, -0.2};
  config["clip"] = {{{"normal", {1, 0, 0}}, {"offset", 0.45 / norm}}};
  config["optical_model"] = model({{0, tau}}, {{0, 0.5, 0.6, 0.7}});
  RayIntegral truth;
  for (std::size_t c = 0; c < 3; ++c) {
    truth.T[c] = std::exp(-tau * 0.45);
    truth.I[c] = (0.5 + 0.1 * double(c)) * (1 - truth.T[c]);
  }
  const double e = error_in_fp64(config, truth, 1e-9);
  std::printf("fp64 clipped: error %.2e\n", e);
  EXPECT_LE(e, 1e-13);
}

TEST(Fp64, DirectConvergesOnTheGoldenRamp) {
  const json g = golden_case("seg_ramp_up");
  if (g.is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  const json& ray = g.at("ray");
  const double length = ray.at("dl");
  std::vector<double> e;
  for (int n : {3750, 7500, 15000, 30000, 60000}) {
    json config = ray_config(ramp_field(ray.at("v0"), ray.at("v1"), length), length, length / n);
    config["optical_model"] = model(g.at("params").at("tau"), g.at("params").at("color"));
    e.push_back(error_in_fp64(config, golden_integral(g), 1e-7));
  }
  for (std::size_t k = 1; k < e.size(); ++k) {
    const double order = std::log2(e[k - 1] / e[k]);
    std::printf("fp64 seg_ramp_up: N = %d: error %.3e, order %.3f\n", 3750 << k, e[k], order);
    EXPECT_NEAR(order, 2, 0.2);  // the medium's nodes lie anywhere in their segments
  }
  EXPECT_LE(e.back(), 1e-10);
}

TEST(Fp64, ShadedSphereConverges) {
  const json g = golden_case("levoy_sphere");
  if (g.is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  std::vector<double> e;
  for (int n : {2048, 32768}) e.push_back(error_in_fp64(direct_config(g, n), golden_integral(g), 1e-7));
  std::printf("fp64 levoy_sphere: error %.2e %.2e at N = 2048, 32768\n", e[0], e[1]);
  EXPECT_LE(e[1], e[0] / 64);  // 256 is order 2; the kinks of the transfer functions take part of it
  EXPECT_LE(e[1], 2e-9);
}

// A table that only has fp32 values is refused by name, and is never read in their place.
TEST(Fp64, TableWithoutFp64ValuesIsRefused) {
  json config = ray_config({{"field", "constant"}, {"value", 0.6}}, 1, 0.1);
  config["optical_model"] = model({{0, 1}}, {{0, 1, 1, 1}});
  const auto forget = [](FrameJob& job) {
    for (Buffer& b : job.frame.buffers)
      if (b.name == "medium_node_poly") b.data64 = nullptr;
  };
  EXPECT_NO_THROW(render(config, cpu, forget)) << "fp32 does not need them";
  config["precision"] = "fp64";
  EXPECT_NO_THROW(render(config, cpu));
  try {
    render(config, cpu, forget);
    FAIL() << "expected InputError";
  } catch (const InputError& e) {
    for (const char* word : {"precision", "medium_node_poly", "fp32 values only", "\"strict\""})
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << word << " is not in: " << e.what();
  }
}

}  // namespace
}  // namespace dvrlab::test
