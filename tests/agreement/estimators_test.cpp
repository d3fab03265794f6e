// Agreement of every estimator on hybrid media: the same bits on every backend and instruction set, on real data, lit,
// grey and RGB, with Dirac terms and opaque ranges.
#include <cstdio>
#include <fstream>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

struct Combination {
  std::string name;
  json estimator;
  std::string data;  // engine, ch2, cranium, tooth
  bool rgb, opaque;
  std::string model = "hybrid";       // data_space, shaded, unshaded (absorption_emission)
  std::string light = "blinn_phong";  // surface_scalar, clip_normal (of a clipping plane), none
};
void PrintTo(const Combination& c, std::ostream* out) { *out << c.name; }

std::string file_of(const std::string& data) {
  if (data == "engine") return std::string(DVRLAB_SOURCE) + "/data/engine.nrrd";
  if (data == "ch2") {
    const std::string file = "/usr/share/mricron/templates/ch2.nii.gz";
    return std::ifstream(file) ? file : "";
  }
  return shared_data(data == "tooth" ? "volumes/tooth.nhdr" : "volumes/cranium_ct.nrrd");
}

/// Values a + b u for u in [0, 1] over the interesting part of the data's range.
json config_of(const Combination& c) {
  const double lo = c.data == "cranium" ? -300 : c.data == "tooth" ? 200 : 20;
  const double hi = c.data == "cranium" ? 1500 : c.data == "tooth" ? 1300 : 240;
  const auto at = [&](double u) { return lo + (hi - lo) * u; };
  json model = {{"type", "hybrid"},
                {"length_unit", "voxel"},
                {"dl_std", 1},
                {"dv_std", (hi - lo) * 0.2},
                {"surface",
                 {{"opacity", {{at(0.35), 0}, {at(0.45), 0.8}, {at(0.55), 0}}},
                  {"color", {{at(0), 1, 0.8, 0.6}, {at(1), 0.7, 0.9, 1}}}}},
                {"scattering",
                 {{"opacity", {{at(0.05), 0}, {at(0.3), 0.03}, {at(0.9), 0.1}}},
                  {"color", {{at(0), 0.2, 0.5, 1}, {at(1), 1, 0.6, 0.1}}}}},
                {"emission", {{"intensity", {{at(0.6), 0}, {at(0.8), 0.05}}}, {"color", {{at(0), 1, 0.3, 0.1}}}}}};
  if (c.rgb)
    model["absorption"] = {{"density", {{at(0.1), 0}, {at(0.2), 0.1}, {at(0.3), 0}}},
                           {"transmission_color", {{at(0), 0.9, 0.5, 0.1}}}};
  const std::string type = c.estimator.at("type");
  const bool particles_only = type == "engel_1d" || type == "kye_1d" || c.estimator.value("order", 1) > 1;
  if (type != "direct" && type != "average")
    model["surface"]["delta"] = {{{"value", at(0.62)}, {"opacity", 0.5}, {"color", {0.9, 0.9, 0.2}}}};
  if (c.opaque) model["surface"]["opacity"] = {{at(0.35), 0}, {at(0.45), 0.6}, {at(0.7), 0}, {at(0.7), 1}, {at(1), 1}};
  if (c.model == "data_space") {
    for (const char* key : {"dl_std", "scattering", "absorption", "emission"}) model.erase(key);
    model["type"] = "data_space";
  }
  if (particles_only) model.erase("surface");
  if (c.model == "shaded" || c.model == "unshaded")
    model = {{"type", "absorption_emission"},
             {"shaded", c.model == "shaded"},
             {"length_unit", "voxel"},
             {"opacity", {{at(0.05), 0}, {at(0.3), 0.03}, {at(0.7), 0.3}, {at(0.9), c.opaque ? 1.0 : 0.5}}},
             {"color", {{at(0), 0.2, 0.5, 1}, {at(1), 1, 0.6, 0.1}}}};
  if (c.estimator.value("rule", "trapezoid") != "trapezoid") model.erase("emission");  // has no chromaticity
  if (type == "exact") model["tf"] = "nodes";
  json illumination = json::array({{{"type", "blinn_phong"}}});
  if (c.light == "none") illumination = json::array();
  if (c.light == "surface_scalar")
    illumination = json::array({{{"type", "surface_scalar"}, {"lit_gradient", (hi - lo) * 0.05}}});
  json clip = json::array();
  if (c.light == "clip_normal")
    clip = json::array({{{"frame", "data"}, {"normal", {1, -1, 0.5}}, {"clip_normal", "plane"}, {"clip_depth", 6}},
                        {{"frame", "data"}, {"normal", {0, 0, 1}}, {"offset", 0.3}}});
  return {{"data", {{"type", c.data == "ch2" ? "nifti" : "nrrd"}, {"file", file_of(c.data)}}},
          {"optical_model", model},
          {"estimator", c.estimator},
          {"lights",
           {{{"type", "head"}}, {{"type", "directional"}, {"direction", {1, -0.5, 0.8}}, {"color", {0.6, 0.5, 0.4}}}}},
          {"illumination", illumination},
          {"clip", clip},
          {"camera", {{"type", "perspective"}, {"position", {1.3, -2.2, 1.1}}, {"up", {0, 0, 1}}, {"fov_deg", 34}}},
          {"sampling", {{"type", "uniform"}, {"step", 1.3}, {"termination", 1e-3}}},
          {"image", {{"size", {48, 36}}, {"background", {0.1, 0.2, 0.3}}}}};
}

class AgreementOfEstimators : public testing::TestWithParam<Combination> {};

TEST_P(AgreementOfEstimators, SameBitsOnEveryTarget) {
  if (file_of(GetParam().data).empty()) GTEST_SKIP() << "not supported: no data (" << GetParam().data << ")";
  const json config = config_of(GetParam());
  const FrameResult reference = render(config, targets().front());
  EXPECT_GT(reference.counters.samples, 0u);
  double worst = 0;
  int compared = 0;
  for (std::size_t t = 1; t < targets().size(); ++t) {
    try {
      const FrameResult r = render(config, targets()[t]);
      worst = std::max(worst, largest_difference(reference.image, r.image));
      EXPECT_EQ(differing_values(reference.image, r.image), 0u) << targets()[t].name;
      ++compared;
    } catch (const NotSupported& reason) {
      std::printf("%s: not supported: %s\n", targets()[t].name.c_str(), reason.what());
    }
  }
  std::printf("%s: worst difference %g over %d comparisons\n", GetParam().name.c_str(), worst, compared);
  EXPECT_GT(compared, 0);
  // Negative control: another step is another image.
  json other = config;
  other["sampling"]["step"] = 1.31;
  EXPECT_GT(differing_values(reference.image, render(other, targets().front()).image), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Pairwise, AgreementOfEstimators,
    testing::Values(
        Combination{"direct_engine", {{"type", "direct"}, {"total_variation", true}}, "engine", false, false},
        Combination{"direct_cranium_rgb", {{"type", "direct"}}, "cranium", true, true},
        Combination{"average_ch2", {{"type", "average"}}, "ch2", false, true},
        Combination{
            "average_barycentre_engine", {{"type", "average"}, {"shading", "barycentre"}}, "engine", false, false},
        Combination{"preintegrated_barycentre_ch2",
                    {{"type", "preintegrated"}, {"table_size", 256}, {"shading", "barycentre"}},
                    "ch2",
                    true,
                    false},
        Combination{"preintegrated_constant_engine",
                    {{"type", "preintegrated"}, {"table_size", 256}, {"shading", "constant"}},
                    "engine",
                    false,
                    false},
        Combination{"average_w5_engine_rgb", {{"type", "average"}, {"rule", "exact_depth"}}, "engine", true, false},
        Combination{"approximative_cranium", {{"type", "approximative"}}, "cranium", false, false},
        Combination{"approximative_barycentre_ch2_rgb",
                    {{"type", "approximative"}, {"shading", "barycentre"}},
                    "ch2",
                    true,
                    true},
        Combination{"exact_engine", {{"type", "exact"}}, "engine", false, true},
        Combination{"exact_ch2_rgb", {{"type", "exact"}, {"dirac_shading", "inside"}}, "ch2", true, false},
        Combination{"preintegrated_engine_rgb", {{"type", "preintegrated"}, {"table_size", 256}}, "engine", true, true},
        Combination{"preintegrated_cranium", {{"type", "preintegrated"}, {"table_size", 256}}, "cranium", false, false},
        Combination{"preintegrated_plain_ch2",
                    {{"type", "preintegrated"}, {"table_size", 256}, {"lookup", "plain"}, {"shading", "constant"}},
                    "ch2",
                    false,
                    true},
        Combination{"direct_ch2_data_space", {{"type", "direct"}}, "ch2", false, false, "data_space", "surface_scalar"},
        Combination{"direct_engine_shaded", {{"type", "direct"}}, "engine", false, true, "shaded", "clip_normal"},
        Combination{"average_cranium_unshaded", {{"type", "average"}}, "cranium", false, false, "unshaded", "none"},
        Combination{
            "average_engine_data_space", {{"type", "average"}}, "engine", false, true, "data_space", "clip_normal"},
        Combination{"approximative_engine_shaded",
                    {{"type", "approximative"}},
                    "engine",
                    false,
                    false,
                    "shaded",
                    "surface_scalar"},
        Combination{"approximative_cranium_data_space",
                    {{"type", "approximative"}, {"shading", "barycentre"}},
                    "cranium",
                    false,
                    true,
                    "data_space",
                    "none"},
        Combination{"exact_cranium_shaded", {{"type", "exact"}}, "cranium", false, false, "shaded", "clip_normal"},
        Combination{
            "exact_engine_data_space", {{"type", "exact"}}, "engine", false, false, "data_space", "surface_scalar"},
        Combination{"exact_ch2_unshaded", {{"type", "exact"}}, "ch2", false, true, "unshaded", "none"},
        Combination{"preintegrated_ch2_shaded",
                    {{"type", "preintegrated"}, {"table_size", 256}},
                    "ch2",
                    false,
                    false,
                    "shaded",
                    "surface_scalar"},
        Combination{"preintegrated_engine_data_space",
                    {{"type", "preintegrated"}, {"table_size", 256}},
                    "engine",
                    false,
                    false,
                    "data_space",
                    "clip_normal"},
        Combination{"direct_published_ch2_shaded",
                    {{"type", "direct"}, {"variant", "published"}},
                    "ch2",
                    false,
                    false,
                    "shaded",
                    "blinn_phong"},
        Combination{"power_series_engine", {{"type", "power_series"}}, "engine", false, true},
        Combination{"power_series_ch2_rgb", {{"type", "power_series"}, {"shading", "nonlinear"}}, "ch2", true, false},
        Combination{"power_series_barycentre_cranium",
                    {{"type", "power_series"}, {"shading", "barycentre"}},
                    "cranium",
                    false,
                    false},
        Combination{"power_series_3_engine_rgb",
                    {{"type", "power_series"}, {"order", 3}, {"shading", "nonlinear"}},
                    "engine",
                    true,
                    false},
        Combination{"power_series_2_ch2_unshaded",
                    {{"type", "power_series"}, {"order", 2}, {"opaque_prediction", "published"}},
                    "ch2",
                    false,
                    true,
                    "unshaded",
                    "none"},
        Combination{"power_series_4_cranium_shaded",
                    {{"type", "power_series"}, {"order", 4}, {"fallback", "order1"}},
                    "cranium",
                    false,
                    true,
                    "shaded",
                    "surface_scalar"},
        Combination{
            "power_series_tooth_65536", {{"type", "power_series"}, {"table_size", 65536}}, "tooth", false, true},
        Combination{"preintegrated_tooth_4096",
                    {{"type", "preintegrated"}, {"table_size", 4096}, {"depth_table_size", 65536}},
                    "tooth",
                    false,
                    false,
                    "unshaded",
                    "none"},
        Combination{"engel_1d_engine", {{"type", "engel_1d"}}, "engine", false, false},
        Combination{"engel_1d_ch2_rgb", {{"type", "engel_1d"}, {"shading", "constant"}}, "ch2", true, false},
        Combination{"kye_1d_cranium_shaded", {{"type", "kye_1d"}}, "cranium", false, true, "shaded", "blinn_phong"},
        Combination{"kye_1d_engine_rgb", {{"type", "kye_1d"}}, "engine", true, false},
        Combination{"kye_1d_ch2_unshaded",
                    {{"type", "kye_1d"}, {"opaque_prediction", "off"}},
                    "ch2",
                    false,
                    true,
                    "unshaded",
                    "none"},
        Combination{"exact_nonlinear_engine_rgb", {{"type", "exact"}, {"shading", "nonlinear"}}, "engine", true, false},
        Combination{"preintegrated_nonlinear_engine",
                    {{"type", "preintegrated"}, {"table_size", 256}, {"shading", "nonlinear"}},
                    "engine",
                    false,
                    true},
        Combination{"preintegrated_nonlinear_ch2_rgb",
                    {{"type", "preintegrated"}, {"table_size", 128}, {"shading", "nonlinear"}, {"lookup", "plain"}},
                    "ch2",
                    true,
                    false},
        Combination{"preintegrated_cranium_unshaded",
                    {{"type", "preintegrated"}, {"table_size", 256}, {"lookup", "plain"}},
                    "cranium",
                    false,
                    true,
                    "unshaded",
                    "none"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace dvrlab::test
