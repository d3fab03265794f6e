// The `my_illumination` pass on a plane whose normal is known.
#include <cmath>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

/// A field that grows along x, shaded, homogeneous and opaque, seen along x; a light at `degrees` from the normal.
nlohmann::json plane(double degrees) {
  const double a = degrees * std::acos(-1.0) / 180;
  return {{"data", {{"type", "procedural"}, {"field", "ramp"}, {"evaluate", "formula"}}},
          {"optical_model", {{"type", "absorption_emission"}, {"shaded", true}, {"extinction", {{0, 30}}}}},
          {"estimator", {{"type", "direct"}}},
          {"lights", {{{"type", "directional"}, {"direction", {-std::cos(a), std::sin(a), 0}}}}},
          {"illumination", {{{"type", "my_illumination"}, {"ambient", 0.25}}}},
          {"camera", {{"type", "ray"}, {"frame", "world"}, {"origin", {-2, 0, 0}}, {"direction", {1, 0, 0}}}},
          {"sampling", {{"type", "uniform"}, {"termination", 0}}},
          {"image", {{"size", {1, 1}}}}};
}

float radiance(double degrees) { return render(plane(degrees), targets().front()).image.color[0]; }

TEST(MyIllumination, FollowsLambertsCosine) {
  EXPECT_NEAR(radiance(0), 1, 1e-5);
  EXPECT_NEAR(radiance(60), 0.25 + 0.75 * 0.5, 1e-5);
  EXPECT_NEAR(radiance(90), 0.25, 1e-5);
  EXPECT_GT(std::abs(radiance(61) - (0.25 + 0.75 * 0.5)), 1e-5) << "negative control: another angle";
}

}  // namespace
}  // namespace dvrlab::test
