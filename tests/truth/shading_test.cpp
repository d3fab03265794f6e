// Local shading against closed forms: Kniss's surface scalar, and clipping planes that light with their own normal.
#include <gtest/gtest.h>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

class Shading : public testing::TestWithParam<Target> {
 protected:
  FrameImage image(const json& config) const { return render(config, GetParam()).image; }
};

constexpr double mu = 0.8, length = 2.0;

/// A homogeneous medium of extinction mu and white shaded source, lit from the eye; the field's gradient is `gradient`
/// along the ray.
json lit_ray(double gradient, const json& illumination, int segments) {
  json config = ray_config(ramp_field(0, gradient * length, length), length, length / segments);
  config["optical_model"] = model({{0, mu}}, {{0, 1, 1, 1}});
  config["optical_model"]["shaded"] = true;
  config["estimator"] = {{"type", "exact"}};
  config["lights"] = {{{"type", "head"}}};
  config["illumination"] = {illumination};
  return config;
}

// k = 1 + s (k_bp - 1), b = s b_bp with the surface scalar s of the gradient's magnitude; N.V = N.H = 1 here.
TEST_P(Shading, SurfaceScalarIsLinearInTheGradient) {
  const json kniss = {{"type", "surface_scalar"}, {"ambient", 0.1},        {"diffuse", 0.4},
                      {"specular", 0.3},          {"unlit_gradient", 0.5}, {"lit_gradient", 2.5}};
  for (const double gradient : {0.25, 0.5, 1.0, 2.0, 2.5, 7.0}) {
    const double s = std::clamp((gradient - 0.5) / 2.0, 0.0, 1.0);
    const double light = 1 + s * (0.1 + 0.4 - 1) + s * 0.3;
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage r = image(lit_ray(gradient, kniss, 3));
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(double(r.color[c]), light * (1 - std::exp(-mu * length)), 2e-6) << gradient;
    })
  }
}

/// The integral of mu e^(-mu l) k(l) over the ray, k = 1 + (front - 1) max(0, 1 - l / depth).
double behind_a_plane(double front, double depth) {
  const double T = std::exp(-mu * depth);
  const double ramp = 1 - (1 - T) / (mu * depth);  // of mu e^(-mu l) (1 - l / depth) over [0, depth]
  return (1 - std::exp(-mu * length)) + (front - 1) * ramp;
}

// A field without a gradient has k = ambient + diffuse. Under a plane that is tilted by 60 degrees, k is that of the
// plane's normal at the plane and fades linearly with the distance from it.
TEST_P(Shading, ClippingPlaneLightsWithItsNormal) {
  const json phong = {{"type", "blinn_phong"}, {"ambient", 0.2}, {"diffuse", 0.8}, {"specular", 0}};
  // distance from the plane = l cos 60; the voxel of a formula field is its spacing on the grid of 32 points
  const double voxel = 16.0 / 31, planes_depth = 0.4, depth = planes_depth / 0.5;
  json config = lit_ray(0, phong, 20);
  config["data"] = {{"type", "procedural"}, {"evaluate", "formula"}, {"bounds", {{-8, -8, -8}, {8, 8, 8}}},
                    {"size", {32, 32, 32}}, {"field", "constant"},   {"value", 0.5}};
  json plane = {{"frame", "world"}, {"normal", {-0.5, std::sqrt(0.75), 0}}, {"offset", 0}};
  for (const char* of : {"data", "plane"}) {
    plane["clip_normal"] = of;
    if (of == std::string("plane")) plane["clip_depth"] = planes_depth / voxel;
    config["clip"] = {plane};
    config["camera"]["t"] = {0, length};
    const double front = of == std::string("plane") ? 0.2 + 0.8 * 0.5 : 1;
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage r = image(config);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(double(r.color[c]), behind_a_plane(front, depth), 3e-6) << of;
    })
  }
}

// The nearest plane wins, and a plane without a normal of its own changes nothing.
TEST_P(Shading, NearestClippingPlaneWins) {
  const json phong = {{"type", "blinn_phong"}, {"ambient", 0.2}, {"diffuse", 0.8}, {"specular", 0.5}};
  json config = lit_ray(1, phong, 20);
  const json steep = {{"normal", {-0.5, std::sqrt(0.75), 0}}, {"clip_normal", "plane"}, {"clip_depth", 1}};
  const json far = {{"normal", {0, 1, 0}}, {"offset", 5}, {"clip_normal", "plane"}, {"clip_depth", 1}};
  const json plain = {{"normal", {0, 0, 1}}, {"offset", 0.001}};
  SKIP_WHEN_NOT_SUPPORTED({
    config["clip"] = {steep};
    const FrameImage one = image(config);
    config["clip"] = {far, steep, plain};
    EXPECT_EQ(differing_values(one, image(config)), 0u);
    config["clip"] = {plain};
    EXPECT_GT(differing_values(one, image(config)), 0u);
  })
}

// A Dirac term in a segment has the light of the segment, as the key `shading` says, whoever integrates: also where
// the framework cuts the segment there.
TEST_P(Shading, DiracTermsAreLitLikeTheirSegment) {
  json config = ray_config({{"field", "radial"}, {"center", {1, 0.6, 0}}, {"offset", 0}, {"scale", 0.5}}, 3, 3);
  config["optical_model"] = {{"type", "hybrid"},
                             {"tf", "nodes"},
                             {"scattering", {{"opacity", {{0, 0.1}}}, {"color", {{0, 0.1, 0.1, 0.1}}}}},
                             {"surface", {{"delta", {{{"value", 0.7}, {"opacity", 0.6}}}}}}};
  config["lights"] = {{{"type", "directional"}, {"direction", {0.2, 1, 0.4}}}};
  config["illumination"] = {{{"type", "blinn_phong"}, {"specular", 0.5}, {"shininess", 3}}};
  for (const char* shading : {"constant", "linear"}) {
    SKIP_WHEN_NOT_SUPPORTED({
      config["estimator"] = {{"type", "exact"}, {"shading", shading}};
      const FrameImage exact = image(config);
      config["estimator"]["dirac_shading"] = "inside";
      EXPECT_GT(largest_difference(image(config), exact), 1e-3) << "negative control: its own place is lit otherwise";
      config["estimator"] = {{"type", "preintegrated"}, {"shading", shading}};
      EXPECT_LE(largest_difference(image(config), exact), 2e-5) << shading;
      config["estimator"]["lookup"] = "plain";
      config["estimator"]["table_size"] = 4096;
      EXPECT_LE(largest_difference(image(config), exact), 2e-3) << shading;
    })
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, Shading, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
