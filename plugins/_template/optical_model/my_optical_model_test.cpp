// The `my_optical_model` optical model against a closed form.
#include <cmath>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

/// A field of one value, 1 long, seen along one ray.
nlohmann::json slab(double value) {
  return {
      {"data", {{"type", "procedural"}, {"field", "constant"}, {"value", value}, {"bounds", {{0, 0, 0}, {1, 1, 1}}}}},
      {"optical_model", {{"type", "my_optical_model"}, {"extinction", 3}, {"tf", "nodes"}}},
      {"estimator", {{"type", "direct"}}},
      {"camera", {{"type", "ray"}, {"frame", "world"}, {"origin", {-1, 0.5, 0.5}}, {"direction", {1, 0, 0}}}},
      {"image", {{"size", {1, 1}}}}};
}

float transmittance(double value) { return render(slab(value), targets().front()).image.trans[0]; }

TEST(MyOpticalModel, ExtinctionRisesLinearlyOverTheWindow) {
  EXPECT_EQ(transmittance(0.4), 1.0f);
  EXPECT_NEAR(transmittance(0.45), std::exp(-0.75), 1e-6);
  EXPECT_NEAR(transmittance(0.6), std::exp(-3.0), 1e-6);
  EXPECT_NEAR(transmittance(5), std::exp(-3.0), 1e-6);
  EXPECT_GT(std::abs(transmittance(0.46) - std::exp(-0.75)), 1e-6) << "negative control: another value";
}

TEST(MyOpticalModel, AWindowThatEndsBeforeItBeginsIsRefused) {
  EXPECT_THROW(scene_of(patched(slab(0), {{"optical_model", {{"lower", 1}}}})), InputError);
}

}  // namespace
}  // namespace dvrlab::test
