// An estimator that integrates between the segment's ends, splits at transfer function nodes, crosses a Dirac term,
// and shades at the ends or inside the segment: through the real march on every target.
#include <cmath>

#include "framework/interfaces/error.h"
#include "tests/spike/spike.h"

namespace dvrlab {
namespace {

using namespace spike;
using nlohmann::json;

// A value ramp v0 -> v1 over length dl along x; one ray, one segment.
json segment_case(double v0, double v1, double dl) {
  const double slope = (v1 - v0) / dl;
  return {{"data",
           {{"type", "procedural"},
            {"field", "ramp"},
            {"evaluate", "formula"},
            {"bounds", {{0, -1, -1}, {dl, 1, 1}}},
            {"direction", {1, 0, 0}},
            {"scale", slope},
            {"offset", v0}}},
          {"optical_model", {{"type", "absorption_emission"}, {"tf", "nodes"}, {"length_unit", "world"}}},
          {"estimator", {{"type", "spike_exact"}}},
          {"camera",
           {{"type", "ray"}, {"frame", "world"}, {"origin", {0, 0, 0}}, {"direction", {1, 0, 0}}, {"t", {0, dl}}}},
          {"sampling", {{"type", "uniform"}, {"step", dl}, {"unit", "world"}, {"termination", 0}}},
          {"image", {{"size", {4, 4}}}}};
}

double value(const json& text) { return std::stod(text.get<std::string>()); }

class Golden : public testing::TestWithParam<const char*> {};

TEST_P(Golden, SegmentWithin2em6) {
  const json g = golden(GetParam());
  if (g.is_null()) GTEST_SKIP() << "not supported: no data (" DVRLAB_GOLDEN ")";
  json config = segment_case(g["ray"]["v0"], g["ray"]["v1"], g["ray"]["dl"]);
  config["optical_model"]["extinction"] = g["params"]["tau"];
  config["optical_model"]["color"] = g["params"]["color"];
  for (const int segments : {1, 3, 16}) {  // splitting a segment anywhere changes nothing
    config["sampling"]["step"] = g["ray"]["dl"].get<double>() / segments;
    const FrameResult r = render_everywhere(GetParam(), scene_of(config.dump()).job);
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      worst = std::max(worst, std::fabs(double(r.image.color[c]) - value(g["expect"]["I"][c])));
      worst = std::max(worst, std::fabs(double(r.image.trans[c]) - value(g["expect"]["T"][c])));
    }
    std::printf("%-20s %d segments: worst error %.3g, bound 2e-6\n", GetParam(), segments, worst);
    EXPECT_LE(worst, 2e-6);
  }
}
INSTANTIATE_TEST_SUITE_P(Cases, Golden, testing::Values("seg_homogeneous", "seg_ramp_up", "seg_peak64", "seg_box"),
                         [](const auto& id) { return std::string(id.param); });

// A Dirac term alone: C = (1 - e^-mu)(k c + b), T = e^-mu, wherever samples fall and in both directions.
TEST(SpikeExact, DiracClosedForm) {
  const double mu[3] = {0.7, 1.9, 0.05}, color[3] = {0.9, 0.4, 0.2};
  for (const bool reversed : {false, true}) {
    json config = segment_case(reversed ? 1 : 0, reversed ? 0 : 1, 2.0);
    config["optical_model"]["extinction"] = {{0, 0, 0, 0}, {1, 1e-6, 0, 0}};  // RGB, as good as nothing
    config["estimator"]["dirac_value"] = 0.5;
    config["estimator"]["dirac_depth"] = mu;
    config["estimator"]["dirac_color"] = color;
    for (const int segments : {1, 4, 7}) {  // 4: a sample hits the Dirac exactly; it counts once
      config["sampling"]["step"] = 2.0 / segments;
      const FrameResult r = render_everywhere("dirac", scene_of(config.dump()).job);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(r.image.trans[c], std::exp(-mu[c]), 2e-6) << segments;
        EXPECT_NEAR(r.image.color[c], color[c] * (1 - std::exp(-mu[c])), 2e-6) << segments;
      }
    }
  }
}

// Light linear along the ray: at a Dirac in the middle of one segment k is the mean of the ends. The hole inside the
// segment evaluates the same prescribed light at the Dirac's own place.
TEST(SpikeExact, LightAtTheEndsAndInside) {
  for (const char* light : {"ends", "inside"}) {
    json config = segment_case(0, 1, 2.0);
    config["optical_model"]["extinction"] = {{0, 1e-6}, {1, 1e-6}};
    config["optical_model"]["shaded"] = true;
    config["illumination"] = {{{"type", "prescribed"},
                               {"k0", {0.2, 0.5, 0.9}},
                               {"k1", {1.0, 0.3, 0.1}},
                               {"b0", {0.0, 0.1, 0.2}},
                               {"b1", {0.3, 0.2, 0.0}}}};
    config["estimator"]["dirac_light"] = light;
    config["estimator"]["dirac_value"] = 0.25;
    config["estimator"]["dirac_depth"] = {0.7, 0.7, 0.7};
    config["estimator"]["dirac_color"] = {0.5, 0.6, 0.7};
    const FrameResult r = render_everywhere(std::string("light ") + light, scene_of(config.dump()).job);
    const double k[3] = {0.4, 0.45, 0.7}, b[3] = {0.075, 0.125, 0.15}, c[3] = {0.5, 0.6, 0.7};
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(r.image.color[i], (k[i] * c[i] + b[i]) * (1 - std::exp(-0.7)), 4e-6) << light;
  }
}

json volume_case(bool rgb) {
  json config = json::parse(R"({
    "data": { "type": "procedural", "field": "marschner_lobb", "scale": 255, "voxel_type": "uint8", "size": [48, 48, 48] },
    "optical_model": { "type": "absorption_emission", "shaded": true, "tf": "nodes", "length_unit": "voxel",
                       "extinction": [[0, 0], [90, 0], [100, 0.4], [110, 0.02], [255, 0.1]],
                       "color": [[0, 0.2, 0.5, 0.9], [255, 1, 0.6, 0.2]] },
    "estimator": { "type": "spike_exact", "dirac_value": 180, "dirac_depth": [0.5, 0.5, 0.5], "dirac_color": [1, 0.9, 0.7] },
    "lights": [ { "type": "head" } ], "illumination": [ { "type": "blinn_phong" } ],
    "camera": { "type": "perspective", "frame": "data", "position": [1.5, -2.0, 1.2], "up": [0, 0, 1], "fov_deg": 30 },
    "sampling": { "type": "uniform", "step": 1, "unit": "voxel" },
    "image": { "size": [64, 64], "background": [0.1, 0.2, 0.3] } })");
  if (rgb) {
    config["optical_model"]["extinction"] = json::parse("[[0,0,0,0],[90,0,0,0],[100,0.4,0.2,0.1],[255,0.1,0.2,0.3]]");
    config["estimator"]["dirac_depth"] = {0.5, 0.9, 0.1};
  }
  return config;
}

TEST(SpikeExact, SameBitsOnAShadedVolume) {
  std::vector<FrameResult> by_light;
  for (const bool rgb : {false, true})
    for (const char* light : {"ends", "inside"}) {
      json config = volume_case(rgb);
      config["estimator"]["dirac_light"] = light;
      by_light.push_back(
          render_everywhere(std::string(rgb ? "rgb, " : "grey, ") + light, scene_of(config.dump()).job, 2));
    }
  EXPECT_NE(by_light[0].image.color, by_light[1].image.color) << "the hole inside the segment is not evaluated";
}

TEST(SpikeExact, SameBitsUnlit) {
  for (const bool rgb : {false, true}) {
    json config = volume_case(rgb);
    config["optical_model"]["shaded"] = false;
    render_everywhere(rgb ? "rgb, plain" : "grey, plain", scene_of(config.dump()).job, 2);
  }
}

// The same frame with the estimator that costs least, for the table of docs/adr/0001.
TEST(SpikeExact, DirectForComparison) {
  json config = volume_case(false);
  config["estimator"] = {{"type", "direct"}};
  render_everywhere("direct, lit", scene_of(config.dump()).job, 2);
  config["optical_model"]["shaded"] = false;
  render_everywhere("direct, plain", scene_of(config.dump()).job, 2);
}

TEST(SpikeExact, RefusesATable) {
  json config = volume_case(false);
  config["optical_model"]["tf"] = "table";
  try {
    scene_of(config.dump());
    FAIL() << "it was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("optical_model.tf"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace dvrlab
