// The `my_estimator` estimator against a closed form, on every target, with the same bits everywhere.
#include <cmath>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

/// A homogeneous medium of extinction 2 and white colour, 1 long, seen along one ray.
nlohmann::json slab(double extinction) {
  return {{"data", {{"type", "procedural"}, {"field", "constant"}, {"bounds", {{0, 0, 0}, {1, 1, 1}}}}},
          {"optical_model", {{"type", "absorption_emission"}, {"extinction", {{0, extinction}}}}},
          {"estimator", {{"type", "my_estimator"}}},
          {"camera", {{"type", "ray"}, {"frame", "world"}, {"origin", {-1, 0.5, 0.5}}, {"direction", {1, 0, 0}}}},
          {"sampling", {{"type", "uniform"}, {"step", 0.1}, {"unit", "world"}}},
          {"image", {{"size", {4, 4}}}}};
}

TEST(MyEstimator, HomogeneousMediumIsExact) {
  const FrameImage first = render(slab(2), targets().front()).image;
  for (const Target& target : targets()) {
    try {
      const FrameImage image = render(slab(2), target).image;
      EXPECT_NEAR(image.trans[0], std::exp(-2.0), 1e-6) << target.name;
      EXPECT_NEAR(image.color[0], 1 - std::exp(-2.0), 1e-6) << target.name;
      EXPECT_EQ(differing_values(first, image), 0u) << target.name << " has other bits";
    } catch (const NotSupported& reason) {
      std::printf("%s is not supported: %s\n", target.name.c_str(), reason.what());
    }
  }
  // Negative control: the test sees a medium that is off by a hundredth.
  EXPECT_GT(std::abs(render(slab(2.02), targets().front()).image.trans[0] - std::exp(-2.0)), 1e-6);
}

}  // namespace
}  // namespace dvrlab::test
