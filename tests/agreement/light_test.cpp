// Agreement of light volumes and of what they light: the same bits on every backend and instruction set.
#include <cstring>
#include <fstream>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

struct Lit {
  std::string name;
  json config;  // over base()
};
void PrintTo(const Lit& l, std::ostream* out) { *out << l.name; }

json base() {
  return {
      {"data", {{"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {37, 22, 29}}, {"voxel_type", "uint8"}}},
      {"optical_model",
       {{"type", "absorption_emission"},
        {"length_unit", "voxel"},
        {"opacity", {{0.3, 0}, {0.5, 0.3}, {0.7, 0.02}}},
        {"color", {{0, 1, 0.8, 0.5}, {1, 0.2, 0.7, 1}}}}},
      {"estimator", {{"type", "direct"}}},
      {"lights", {{{"type", "directional"}, {"direction", {1, 0.3, 0.8}}}}},
      {"illumination", {{{"type", "local_piecewise"}, {"radius", 6}, {"samples", 3}, {"segment", 5}}}},
      {"camera", {{"type", "perspective"}, {"position", {1.2, -2.0, 0.9}}, {"up", {0, 0, 1}}}},
      {"sampling", {{"type", "uniform"}, {"step", 0.61}}},
      {"image", {{"size", {40, 36}}}}};
}

json pass(const json& more) { return {{"illumination", {patched(base()["illumination"][0], more)}}}; }
const json direct_only = {{"components", "direct"}, {"radius", nullptr}, {"samples", nullptr}};
json engine() {
  return {{"data",
           {{"type", "nrrd"},
            {"file", std::string(DVRLAB_SOURCE) + "/data/engine.nrrd"},
            {"field", nullptr},
            {"size", nullptr},
            {"voxel_type", nullptr}}},
          {"optical_model", {{"opacity", {{60, 0}, {120, 0.1}, {255, 0.3}}}}},
          {"illumination", {{{"type", "local_piecewise"}, {"components", "direct"}}}}};
}
json hybrid() {
  return {{"optical_model",
           {{"type", "hybrid"},
            {"dl_std", 1},
            {"dv_std", 0.2},
            {"opacity", nullptr},
            {"color", nullptr},
            {"surface",
             {{"opacity", {{0.35, 0}, {0.45, 0.5}, {0.55, 0}}},
              {"color", {{0, 1, 0.8, 0.6}}},
              {"delta", {{{"value", 0.62}, {"opacity", 0.5}, {"color", {0.9, 0.9, 0.2}}}}}}},
            {"scattering", {{"opacity", {{0.05, 0}, {0.9, 0.1}}}, {"color", {{0, 0.2, 0.5, 1}}}}}}},
          {"estimator", {{"type", "approximative"}}}};
}
json both(json config) {
  config["illumination"] = {base()["illumination"][0], {{"type", "blinn_phong"}}};
  return config;
}
json estimator(const json& e) {
  json c = {{"estimator", e}};
  if (e["type"] == "exact") c["optical_model"] = {{"tf", "nodes"}};
  return c;
}

/// A patch that takes the opacity away.
json without_opacity(json config) {
  config["optical_model"]["opacity"] = nullptr;
  return config;
}

std::vector<Lit> lits() {
  const json points = {{"lights",
                        {{{"type", "point"}, {"position", {0.1, 0.2, 0.3}}, {"color", {1, 0.7, 0.4}}},
                         {{"type", "head"}, {"color", {0.3, 0.3, 0.3}}},
                         {{"type", "directional"}, {"direction", {-1, 0.2, 0}}, {"frame", "camera"}}}}};
  const json rgb = {
      {"optical_model",
       {{"opacity", nullptr}, {"extinction", {{0.3, 0, 0, 0}, {0.5, 0.3, 0.2, 0.1}, {0.7, 0.02, 0.02, 0.1}}}}}};
  return {
      {"scattered", json::object()},
      {"sum_physical", pass({{"components", "sum"}, {"normalisation", "physical"}, {"albedo", 0.8}, {"orders", 2}})},
      {"henyey_greenstein", pass({{"phase", "henyey_greenstein"}, {"g", 0.4}, {"weights", "solid_angle"}})},
      {"lobes_of_values",
       pass({{"phase", "henyey_greenstein"}, {"g_of_value", {{0.3, -0.5}, {0.7, 0.8}}}, {"progressive", true}})},
      {"interpolated", pass(patched(direct_only, {{"first_segment", "interpolated"}, {"shadow_ratio", {1, 2, 3}}}))},
      {"icosahedron", pass({{"solid", "icosahedron"}, {"subdivisions", 0}, {"bias", 0.2}, {"blend", 0.7}})},
      {"points_inside_and_outside", points},
      {"rgb_extinction", rgb},
      {"rgb_extinction_of_points", without_opacity(patched(patched(base(), points), rgb))},
      {"hybrid", hybrid()},
      {"with_blinn_phong", both(hybrid())},
      {"full", {{"illumination", {{{"type", "shadow_full"}, {"step", 0.7}}}}}},
      {"full_with_surfaces", patched(hybrid(), {{"illumination", {{{"type", "shadow_full"}}}}})},
      {"ambient_occlusion", {{"illumination", {{{"type", "local_ambient_occlusion"}, {"radius", 5}, {"samples", 3}}}}}},
      {"formula", patched({{"data", {{"evaluate", "formula"}, {"voxel_type", nullptr}}}}, pass({{"resolution", 20}}))},
      {"engine", engine()},
      {"blocks", {{"sampler", {{"type", "flat_blocking"}, {"reduction", 3}}}}},
      {"blocks_clamped",
       {{"sampler", {{"type", "flat_blocking"}, {"reduction", 3}, {"block_border", "clamp"}, {"block", 8}}}}},
      {"blocks_of_hybrid", patched(both(hybrid()), {{"sampler", {{"type", "flat_blocking"}, {"reduction", 2}}}})},
      {"blocks_with_points",
       without_opacity(patched(patched(points, rgb),
                               {{"sampler", {{"type", "flat_blocking"}, {"levels", "tolerance"}, {"tolerance", 3}}}}))},
      {"levels", pass({{"storage", "unorm16"}})},
      {"levels_at_both_ends", patched(estimator({{"type", "preintegrated"}, {"table_size", 128}}),
                                      patched(pass({{"storage", "unorm16"}}), {{"data", {{"voxel_type", "int8"}}}}))},
      {"levels_with_neighbours",
       patched(
           both(hybrid()),
           {{"illumination", {patched(base()["illumination"][0], {{"storage", "unorm16"}}), {{"type", "blinn_phong"}}}},
            {"data", {{"voxel_type", "uint16"}}}})},
      {"levels_of_signed_voxels",
       patched(patched(pass({{"storage", "unorm16"}}), {{"data", {{"voxel_type", "int16"}}}}),
               {{"sampling", {{"jitter", 0.5}}}})},
      {"levels_in_colours", patched(points, pass({{"storage", "unorm16"}}))},
      {"levels_of_blocks",
       patched(pass({{"storage", "unorm16"}}), {{"sampler", {{"type", "flat_blocking"}, {"reduction", 3}}}})},
      {"preintegrated", estimator({{"type", "preintegrated"}, {"table_size", 128}})},
      {"preintegrated_nonlinear",
       estimator({{"type", "preintegrated"}, {"table_size", 128}, {"lookup", "plain"}, {"shading", "nonlinear"}})},
      {"power_series", estimator({{"type", "power_series"}})},
      {"exact", estimator({{"type", "exact"}})},
      {"exact_nonlinear", estimator({{"type", "exact"}, {"shading", "nonlinear"}})},
      {"average", estimator({{"type", "average"}})},
      {"mesh", patched(patched(base(), {{"data", {{"evaluate", "mesh"}, {"size", {7, 6, 5}}, {"cells", "tetrahedra5"}}},
                                        {"estimator", {{"type", "exact"}}},
                                        {"optical_model", {{"tf", "nodes"}, {"length_unit", "world"}, {"dl_std", 0.1}}},
                                        {"sampling", {{"type", "faces"}, {"step", 100}}}}),
                       pass({{"resolution", 20}}))},
      {"curved_mesh",
       patched(patched(base(), {{"data", {{"evaluate", "mesh"}, {"size", {5, 4, 4}}, {"cells", "hexahedra20"}}},
                                {"estimator", {{"type", "approximative"}}},
                                {"optical_model", {{"length_unit", "world"}, {"dl_std", 0.1}}},
                                {"sampling", {{"type", "faces"}, {"step", 0.2}}}}),
               pass({{"resolution", 16}}))}};
}

class LightAgreement : public testing::TestWithParam<Lit> {};

TEST_P(LightAgreement, SameBitsEverywhere) {
  json config = patched(base(), GetParam().config);
  if (config["data"].value("evaluate", "grid") != "grid") config["data"].erase("voxel_type");
  LightVolume first;
  FrameImage image;
  int compared = 0;
  for (const Target& target : targets()) {
    try {
      const LightVolume volume = illuminate(config, target);
      const FrameImage lit = render(config, target).image;
      if (compared++ == 0) {
        first = volume;
        image = lit;
        const auto [least, most] = std::minmax_element(volume.values->begin(), volume.values->end());
        EXPECT_LT(*least, *most) << "light that is the same everywhere shows nothing";
        continue;
      }
      ASSERT_EQ(first.values->size(), volume.values->size());
      std::size_t different = 0;
      for (std::size_t k = 0; k < first.values->size(); ++k)
        different += std::memcmp(&(*first.values)[k], &(*volume.values)[k], sizeof(float)) != 0 ? 1 : 0;
      std::printf("%-26s %-10s light: %zu of %zu differ; image: %zu differ\n", GetParam().name.c_str(),
                  target.name.c_str(), different, first.values->size(), differing_values(image, lit));
      EXPECT_EQ(different, 0u) << target.name;
      EXPECT_EQ(differing_values(image, lit), 0u) << target.name;
    } catch (const NotSupported& reason) {
      std::printf("%-26s %-10s not supported: %s\n", GetParam().name.c_str(), target.name.c_str(), reason.what());
    }
  }
  EXPECT_GT(compared, 1);
}

INSTANTIATE_TEST_SUITE_P(Lights, LightAgreement, testing::ValuesIn(lits()), [](const auto& i) { return i.param.name; });

// Random walks: the same bits for every instruction set of the cpu; software GPUs say why not.
TEST(PathTracedAgreement, SameBitsOnTheCpu) {
  const json config =
      patched(base(), {{"data", {{"size", {9, 8, 7}}}},
                       {"illumination", {{{"type", "path_traced"}, {"samples", 32}, {"phase", "henyey_greenstein"}}}}});
  LightVolume first;
  for (const Target& target : targets()) {
    if (target.name.starts_with("cpu")) {
      try {
        const LightVolume v = illuminate(config, target);
        if (!first.values) first = v;
        EXPECT_EQ(*first.values, *v.values) << target.name;
        EXPECT_EQ(*first.error, *v.error) << target.name;
      } catch (const NotSupported&) {  // an instruction set that this processor has not
      }
    }
  }
  ASSERT_TRUE(first.values);
}

}  // namespace
}  // namespace dvrlab::test
