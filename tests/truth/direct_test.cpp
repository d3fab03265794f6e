// Truth through the real march of every target: rays whose integral is known by formula.
#include <cmath>
#include <cstdio>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

class Truth : public testing::TestWithParam<Target> {
 protected:
  /// Error against `truth`, or NaN with the test marked as skipped when the target is not here.
  double error(const json& config, const RayIntegral& truth) {
    return error_of(render(config, GetParam()).image, truth);
  }
};

// docs/math B.1 for a homogeneous medium is exact: c (1 - e^(-tau l)), e^(-tau l). Any number of segments.
TEST_P(Truth, HomogeneousMediumInClosedForm) {
  const double length = 0.7, tau = 4.0;
  RayIntegral truth;
  for (std::size_t c = 0; c < 3; ++c) {
    truth.T[c] = std::exp(-tau * length);
    truth.I[c] = (c == 0 ? 0.82 : 0.34) * (1 - truth.T[c]);
  }
  const json absorbing = model({{0, tau}}, {{0, 0.82, 0.34, 0.34}});
  for (double step : {0.7, 0.35, 0.1, 0.013, 0.001}) {
    json config = ray_config({{"field", "constant"}, {"value", 0.6}}, length, step);
    config["optical_model"] = absorbing;
    SKIP_WHEN_NOT_SUPPORTED({
      const double e = error(config, truth);
      std::printf("homogeneous, step %g: error %.2e\n", step, e);
      // Each segment rounds its transmittance and the product, both by half an ULP: N 2^-24 in all.
      EXPECT_LE(e, std::max(2e-6, length / step / 16777216.0)) << "step " << step;
    })
  }
}

TEST_P(Truth, GoldenSegmentHomogeneous) {
  const json g = golden_case("seg_homogeneous");
  if (g.is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  json config = ray_config({{"field", "constant"}, {"value", g.at("ray").at("v0")}}, g.at("ray").at("dl"), 0.05);
  config["optical_model"] = model(g.at("params").at("tau"), g.at("params").at("color"));
  SKIP_WHEN_NOT_SUPPORTED({
    const double e = error(config, golden_integral(g));
    std::printf("seg_homogeneous: error %.2e\n", e);
    EXPECT_LE(e, 2e-6);
  })
}

// The other golden segments converge: second order while the medium is smooth on the scale of a segment.
TEST_P(Truth, GoldenSegmentsConverge) {
  struct Row {
    const char* id;
    double last;  // bound at 4096 segments, a quarter of the error that 2048 segments may have
  };
  for (const Row& row : {Row{"seg_ramp_up", 2e-6}, Row{"seg_peak64", 2e-4}, Row{"seg_box", 2e-3}}) {
    const json g = golden_case(row.id);
    if (g.is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
    const json& ray = g.at("ray");
    const double length = ray.at("dl"), v0 = ray.at("v0"), v1 = ray.at("v1");
    std::vector<double> e;
    for (int n : {64, 256, 1024, 4096}) {
      json config = ray_config(ramp_field(v0, v1, length), length, length / n);
      config["optical_model"] = model(g.at("params").at("tau"), g.at("params").at("color"));
      SKIP_WHEN_NOT_SUPPORTED(e.push_back(error(config, golden_integral(g))))
    }
    std::printf("%s: error %.2e %.2e %.2e %.2e at N = 64, 256, 1024, 4096\n", row.id, e[0], e[1], e[2], e[3]);
    EXPECT_LT(e[1], e[0]) << row.id;
    EXPECT_LT(e[2], e[1]) << row.id;
    EXPECT_LE(e[3], row.last) << row.id;
  }
}

// golden levoy_sphere: shaded, radial field, headlight; k and b come from the real shading kernel.
TEST_P(Truth, GoldenLevoySphereConverges) {
  const json g = golden_case("levoy_sphere");
  if (g.is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  std::vector<double> e;
  for (int n : {32, 128, 512, 2048}) {
    const json config = direct_config(g, n);
    SKIP_WHEN_NOT_SUPPORTED(e.push_back(error(config, golden_integral(g))))
  }
  std::printf("levoy_sphere: error %.2e %.2e %.2e %.2e at N = 32, 128, 512, 2048\n", e[0], e[1], e[2], e[3]);
  EXPECT_LT(e[1], e[0] / 8);
  EXPECT_LT(e[2], e[1]);
  EXPECT_LE(e[3], 5e-6);
}

// docs/math B.1: `direct` is of order 2 on the ramp medium. The reference is our own fp64 integration.
TEST_P(Truth, DirectIsOfSecondOrder) {
  const json tau = {{0, 0.5}, {1, 5.5}}, color = {{0, 0.1, 0.9, 0.5}, {1, 0.9, 0.2, 0.4}};
  const double v0 = 0.0037, v1 = 0.9963;
  const RayIntegral truth = integrate(
      tau, color, [&](double l) { return v0 + (v1 - v0) * l; }, 1.0, 20000);
  std::vector<double> e;
  for (int n : {8, 16, 32, 64}) {
    json config = ray_config(ramp_field(v0, v1, 1.0), 1.0, 1.0 / n);
    config["optical_model"] = model(tau, color);
    SKIP_WHEN_NOT_SUPPORTED(e.push_back(error(config, truth)))
  }
  for (std::size_t k = 1; k < e.size(); ++k) {
    const double order = std::log2(e[k - 1] / e[k]);
    std::printf("direct on ramp: N %d -> %d: error %.3e -> %.3e, order %.3f\n", 4 << k, 8 << k, e[k - 1], e[k], order);
    EXPECT_GE(order, 1.8);
    EXPECT_LE(order, 2.2);
  }
}

// Light factors prescribed at both ends: k linear along a homogeneous ray has a closed form,
// C = c [k0 (phi1 - psi) + k1 psi] tau l + b likewise, the whole ray taken as one segment (docs/math B.0).
TEST_P(Truth, PrescribedLightConverges) {
  const double length = 1.0, tau = 1.5, Q = tau * length;
  const double phi = (1 - std::exp(-Q)) / Q, psi = (1 - (1 + Q) * std::exp(-Q)) / (Q * Q);
  RayIntegral truth;
  const std::array<double, 3> c{0.8, 0.5, 0.2}, k0{1, 0.5, 0.2}, k1{0.1, 0.9, 0.4}, b0{0, 0.1, 0.2}, b1{0.3, 0.2, 0.1};
  for (std::size_t n = 0; n < 3; ++n) {
    truth.T[n] = std::exp(-Q);
    truth.I[n] = Q * (c[n] * (k0[n] * (phi - psi) + k1[n] * psi) + b0[n] * (phi - psi) + b1[n] * psi);
  }
  json config = ray_config({{"field", "constant"}, {"value", 0.5}}, length, length / 512);
  config["optical_model"] = model({{0, tau}}, {{0, c[0], c[1], c[2]}});
  config["optical_model"]["shaded"] = true;
  config["illumination"] = {{{"type", "prescribed"}, {"k0", k0}, {"k1", k1}, {"b0", b0}, {"b1", b1}}};
  SKIP_WHEN_NOT_SUPPORTED({
    const double e = error(config, truth);
    std::printf("prescribed light: error %.2e\n", e);
    EXPECT_LE(e, 3e-6);
  })
}

INSTANTIATE_TEST_SUITE_P(Targets, Truth, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
