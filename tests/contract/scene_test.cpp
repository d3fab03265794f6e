// What the scene stage refuses or says aloud, and the sign of normals.
#include "framework/interfaces/field.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

json small() {
  return {{"data", {{"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {16, 16, 16}}}},
          {"optical_model", {{"type", "absorption_emission"}, {"opacity", {{0, 0}, {1, 0.4}}}, {"shaded", true}}},
          {"estimator", {{"type", "direct"}}},
          {"camera", {{"type", "perspective"}, {"position", {1.2, -2.0, 0.9}}}},
          {"image", {{"size", {8, 8}}}}};
}

// One-sided shading of a file with a negative slope: normals follow the physical value.
TEST(Sampler, GradientFollowsThePhysicalValue) {
  GridField grid;
  grid.dims = {2, 2, 2};
  grid.type = VoxelType::u8;
  grid.voxels = std::make_shared<std::array<std::uint8_t, 8>>();
  grid.source = "test";
  const auto row = [&](double slope) {
    grid.slope = slope;
    for (const Uniform& u : registry().get<SamplerPlugin>("sampler", "grid").bind(grid).uniforms)
      if (u.name == "grid_gradient_x") return u.f[0];
    return 0.0;
  };
  EXPECT_EQ(row(2.0), 1.0);
  EXPECT_EQ(row(-2.0), -1.0);
}

std::string refusal(const json& config) {
  try {
    scene_of(config);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Scene, MoreSegmentsThanAGpuMarchesAreRefused) {
  EXPECT_EQ(refusal(patched(small(), {{"sampling", {{"type", "uniform"}, {"step", 0.001}}}})), "");
  EXPECT_NE(refusal(patched(small(), {{"sampling", {{"type", "uniform"}, {"step", 0.0001}}}})).find("sampling.step"),
            std::string::npos);
}

TEST(Scene, SecondLocalShadingPassIsRefused) {
  const json twice = {{"illumination", {{{"type", "blinn_phong"}}, {{"type", "prescribed"}}}}};
  EXPECT_NE(refusal(patched(small(), twice)).find("illumination[1]"), std::string::npos);
}

TEST(Scene, ShadedModelWithoutIlluminationIsSaidAloud) {
  const auto said = [](const Scene& s) {
    for (const std::string& note : s.notes)
      if (note.find("no illumination pass") != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(said(scene_of(small())));
  EXPECT_FALSE(said(scene_of(patched(small(), {{"illumination", {{{"type", "blinn_phong"}}}}}))));
}

}  // namespace
}  // namespace dvrlab::test
