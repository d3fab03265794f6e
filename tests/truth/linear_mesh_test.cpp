// `exact` through linear tetrahedra: a ramp is linear in each of them and along the whole ray, so however many cells
// the ray crosses, it meets the integral of one straight segment.
#include <cstdio>

#include "tests/support/segment_integral.h"
#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

constexpr Vector3 slope = {0.6, -0.5, 0.7}, from = {-0.9, 0.5, -0.45}, along = {1.7, -1.1, 0.9};
constexpr double offset = 0.5, scale = 0.3, length = 2.1;  // the ray stays inside the box

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The ramp at arc length t of the ray, by hand.
double value_at(double t) {
  return offset + scale * (dot(slope, from) + t * dot(slope, along) / std::sqrt(dot(along, along))) /
                      std::sqrt(dot(slope, slope));
}

const json layers = {{"type", "absorption_emission"},
                     {"tf", "nodes"},
                     {"extinction", {{0, 0.1}, {0.4, 0.2}, {0.5, 4}, {0.6, 0.5}, {1, 2}}},
                     {"color", {{0, 0.1, 0.3, 1}, {0.5, 1, 0.8, 0.2}, {1, 0.7, 0.1, 0.4}}}};

json ray_through(const std::string& cells, const json& model) {
  return {{"data",
           {{"type", "procedural"},
            {"field", "ramp"},
            {"evaluate", "mesh"},
            {"cells", cells},
            {"size", {9, 8, 7}},
            {"jitter", 0.3},
            {"bounds", {{-1, -0.8, -0.6}, {1, 0.8, 0.6}}},
            {"direction", slope},
            {"offset", offset},
            {"scale", scale}}},
          {"optical_model", model},
          {"estimator", {{"type", "exact"}}},
          {"camera", {{"type", "ray"}, {"frame", "world"}, {"origin", from}, {"direction", along}, {"t", {0, length}}}},
          {"sampling", {{"type", "faces"}, {"step", 100}, {"termination", 0}}},
          {"image", {{"size", {1, 1}}}}};
}

RayIntegral truth_of(const json& config) {
  const Scene scene = scene_of(config);
  const auto stored = [&](double t) { return (value_at(t) - scene.field->intercept) / scene.field->slope; };
  const SegmentIntegral s = integrate_segment(scene.medium, stored(0), stored(length), length);
  RayIntegral truth;
  for (std::size_t c = 0; c < 3; ++c) {
    truth.I[c] = s.E[c] + s.P[c] + s.S[c];
    truth.T[c] = s.T[c];
  }
  return truth;
}

class LinearMesh : public testing::TestWithParam<Target> {};

TEST_P(LinearMesh, ExactMeetsTheFormula) {
  for (const char* cells : {"tetrahedra5", "tetrahedra6"}) {
    const json config = ray_through(cells, layers);
    SKIP_WHEN_NOT_SUPPORTED({
      const double error = error_of(render(config, GetParam()).image, truth_of(config));
      std::printf("%s: error %.1e\n", cells, error);
      EXPECT_LE(error, 5e-6) << cells;
    })
  }
}

TEST(LinearMeshFp64, ExactMeetsTheFormula) {
  const Target cpu{"cpu fp64", {{"type", "cpu"}}};
  for (const char* cells : {"tetrahedra5", "tetrahedra6"}) {
    json config = ray_through(cells, layers);
    config["precision"] = "fp64";
    const RayIntegral truth = truth_of(config);
    const auto error = [&] {
      const FrameImage r = render(config, cpu).image;
      double worst = 0;
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max({worst, std::abs(r.radiance(c) - truth.I[c]), std::abs(r.transmittance(c) - truth.T[c])});
      return worst;
    };
    const double exact = error();
    std::printf("fp64 %s: error %.1e\n", cells, exact);
    EXPECT_LE(exact, 1e-11) << cells;
    config["optical_model"]["extinction"][2][1] = 4 * (1 + 1e-9);
    EXPECT_GT(error(), 1e-11) << "negative control: a node that is 1e-9 higher";
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, LinearMesh, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
