// The `my_sampler` sampler: values of the nearest grid points, the same bits on every target.
#include <cmath>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

/// A ramp of 5 grid points over [0, 1] along x whose value is its own extinction, seen along x.
nlohmann::json ramp(const std::string& sampler) {
  return {
      {"data", {{"type", "procedural"}, {"field", "ramp"}, {"bounds", {{0, 0, 0}, {1, 1, 1}}}, {"size", {5, 5, 5}}}},
      {"sampler", {{"type", sampler}}},
      {"optical_model", {{"type", "absorption_emission"}, {"extinction", {{0, 0}, {1, 1}}}}},
      {"estimator", {{"type", "direct"}}},
      {"camera",
       {{"type", "ray"}, {"frame", "world"}, {"origin", {-1, 0.4, 0.4}}, {"direction", {1, 0, 0}}, {"t", {1, 1.625}}}},
      {"sampling", {{"type", "uniform"}, {"step", 0.03125}, {"unit", "world"}, {"termination", 0}}},
      {"image", {{"size", {4, 4}}}}};
}

TEST(MySampler, TakesTheNearestGridPoint) {
  // From x = 0 to 5/8 the nearest values are 0 (1/8 long), 1/4 (1/4 long) and 1/2 (1/4 long).
  const FrameImage first = render(ramp("my_sampler"), targets().front()).image;
  EXPECT_NEAR(first.trans[0], std::exp(-(0.25 + 0.5) / 4), 1e-6);
  for (const Target& target : targets()) {
    try {
      EXPECT_EQ(differing_values(first, render(ramp("my_sampler"), target).image), 0u) << target.name;
    } catch (const NotSupported& reason) {
      std::printf("%s is not supported: %s\n", target.name.c_str(), reason.what());
    }
  }
  // Negative control: interpolation gives another depth, the integral of x.
  EXPECT_NEAR(render(ramp("grid"), targets().front()).image.trans[0], std::exp(-0.625 * 0.625 / 2), 1e-5);
}

}  // namespace
}  // namespace dvrlab::test
