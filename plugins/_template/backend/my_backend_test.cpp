// The `my_backend` backend: the bits of the cpu backend, for plain and for shaded frames of an odd size.
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

nlohmann::json scene(bool shaded) {
  return {{"data", {{"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {16, 17, 18}}}},
          {"optical_model",
           {{"type", "absorption_emission"},
            {"shaded", shaded},
            {"length_unit", "voxel"},
            {"opacity", {{0.3, 0, 0, 0}, {0.8, 0.2, 0.3, 0.4}}}}},
          {"estimator", {{"type", "direct"}}},
          {"illumination", {{{"type", "blinn_phong"}}}},
          {"camera", {{"type", "perspective"}, {"position", {1.6, -2.4, 1.4}}}},
          {"image", {{"size", {23, 19}}, {"background", {0.1, 0.2, 0.3}}}}};
}

TEST(MyBackend, HasTheBitsOfTheCpuBackend) {
  const Target cpu{"cpu", {{"type", "cpu"}}}, mine{"my_backend", {{"type", "my_backend"}}};
  for (const bool shaded : {false, true}) {
    const FrameResult a = render(scene(shaded), cpu), b = render(scene(shaded), mine);
    EXPECT_EQ(differing_values(a.image, b.image), 0u);
    EXPECT_EQ(a.counters.samples, b.counters.samples);
    EXPECT_GT(b.counters.samples, 0u);
  }
  // Negative control: the comparison sees another frame.
  EXPECT_GT(differing_values(render(scene(false), cpu).image, render(scene(true), mine).image), 0u);
}

}  // namespace
}  // namespace dvrlab::test
