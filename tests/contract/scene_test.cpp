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

// What the papers explain their speeds by: fetches of four numbers per segment.
TEST(Scene, CountsTableFetches) {
  const auto fetches = [](const json& patch) { return scene_of(patched(small(), patch)).job.table_fetches; };
  const json unlit = {{"optical_model", {{"shaded", false}}}};
  const auto of = [&](const json& estimator, const json& more = json::object()) {
    json patch = unlit;
    patch["estimator"] = estimator;
    patch.merge_patch(more);
    return fetches(patch);
  };
  EXPECT_EQ(of({{"type", "direct"}}), 2) << "value and difference";
  EXPECT_EQ(of({{"type", "average"}}), 4);
  EXPECT_EQ(of({{"type", "approximative"}}), 6);
  EXPECT_EQ(of({{"type", "power_series"}}), 6) << "order 1 without light is a mean";
  EXPECT_EQ(of({{"type", "power_series"}, {"order", 3}, {"fallback", "none"}}), 2 + 2 + 2 * 3);
  EXPECT_EQ(of({{"type", "power_series"}, {"order", 3}}), 2 + 2 + 2 * 3 + 6) << "the depth of the whole segment";
  EXPECT_EQ(of({{"type", "preintegrated"}, {"table_size", 16}, {"lookup", "plain"}}), 3);
  EXPECT_EQ(of({{"type", "preintegrated"}, {"table_size", 16}}), 3 + 6);
  // One interval between two nodes, and two constant ones around it: the search over 4, its interval, a polynomial.
  const json nodes = {{"optical_model", {{"tf", "nodes"}}}};
  EXPECT_EQ(of({{"type", "direct"}}, nodes), 2 + 1 + 3);
  EXPECT_EQ(of({{"type", "exact"}}, nodes), 2 + 1 + 3);
  // Opaque values: where the next one lies.
  const json opaque = {{"optical_model", {{"opacity", {{0.4, 0}, {0.4, 1}, {0.6, 1}, {0.6, 0}}}}}};
  EXPECT_EQ(of({{"type", "approximative"}}, opaque), 7);
  EXPECT_EQ(of({{"type", "approximative"}, {"opaque_prediction", "off"}}, opaque), 6);
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
