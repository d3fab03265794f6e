// Agreement: every backend and instruction set gives the same bits, in strict mode, on every voxel type, shaded or
// not, clipped or not, with and without skipping, with the volume in one GPU buffer or in pages.
#include <cstdio>
#include <fstream>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

struct Volume {
  std::string name;
  std::string file;    // "" when it is not here
  json model;          // transfer functions in physical values
  std::uint64_t page;  // lowered GPU buffer range that cuts it into several pages
};

json tf(const json& opacity, const json& color) {
  return {{"type", "absorption_emission"}, {"opacity", opacity}, {"color", color}, {"length_unit", "voxel"}};
}

std::string shipped(const std::string& name) { return std::string(DVRLAB_SOURCE) + "/data/" + name; }

std::vector<Volume> volumes() {
  const auto colors = [&](double lo, double hi) {
    return json{{lo, 0.2, 0.4, 1}, {0.5 * (lo + hi), 0.9, 0.8, 0.6}, {hi, 1, 0.7, 0.3}};
  };
  const std::string ch2 = "/usr/share/mricron/templates/ch2.nii.gz";
  return {{"engine", shipped("engine.nrrd"),
           tf({{70, 0}, {90, 0.05}, {140, 0.02}, {180, 0.6}, {255, 0.9}}, colors(0, 255)), 2u << 20},
          {"ch2", std::ifstream(ch2) ? ch2 : "", tf({{20, 0}, {60, 0.02}, {110, 0.2}, {255, 0.5}}, colors(0, 255)),
           1u << 20},
          {"tooth", shared_data("volumes/tooth.nhdr"), tf({{400, 0}, {700, 0.1}, {1300, 0.8}}, colors(300, 1300)),
           1u << 20},
          {"cranium", shared_data("volumes/cranium_ct.nrrd"),
           tf({{-300, 0}, {-100, 0.02}, {200, 0.03}, {400, 0.5}, {2000, 0.9}}, colors(-300, 2000)), 4u << 20},
          {"hydrogen", shipped("hydrogen.nrrd"),
           tf({{-0.6, 0.2}, {-0.05, 0}, {0.05, 0}, {0.6, 0.3}}, colors(-0.6, 0.6)), 1u << 18}};
}

json config_of(const Volume& v, bool shaded, bool clipped, bool skipping) {
  json c = {{"data", {{"type", v.file.ends_with(".nii.gz") ? "nifti" : "nrrd"}, {"file", v.file}}},
            {"optical_model", v.model},
            {"estimator", {{"type", "direct"}}},
            {"lights",
             {{{"type", "head"}},
              {{"type", "directional"}, {"direction", {1, -0.5, 0.8}}, {"color", {0.6, 0.5, 0.4}}},
              {{"type", "point"}, {"frame", "data"}, {"position", {-0.5, 1.5, 0.6}}, {"color", {0.2, 0.3, 0.5}}}}},
            {"camera", {{"type", "perspective"}, {"position", {1.3, -2.2, 1.1}}, {"up", {0, 0, 1}}, {"fov_deg", 34}}},
            {"sampling", {{"type", "uniform"}, {"step", 0.73}, {"skipping", skipping}, {"termination", 1e-3}}},
            {"image", {{"size", {72, 52}}, {"background", {0.1, 0.2, 0.3}}}}};
  c["optical_model"]["shaded"] = shaded;
  if (shaded) c["illumination"] = {{{"type", "blinn_phong"}}};
  if (clipped) c["clip"] = {{{"frame", "data"}, {"normal", {1, -1, 0.5}}, {"offset", 0.1}}};
  return c;
}

class Agreement : public testing::TestWithParam<Volume> {};

void PrintTo(const Volume& v, std::ostream* out) { *out << v.name; }

// The first target is the reference; returns false when nothing but it could run.
void compare_targets(const json& config, const std::string& what, double& worst, int& compared, int& missing) {
  FrameResult reference = render(config, targets().front());
  EXPECT_GT(reference.counters.samples, 0u) << what;
  for (std::size_t t = 1; t < targets().size(); ++t) {
    try {
      const FrameResult r = render(config, targets()[t]);
      const double d = largest_difference(reference.image, r.image);
      worst = std::max(worst, d);
      ++compared;
      EXPECT_EQ(differing_values(reference.image, r.image), 0u) << what << " on " << targets()[t].name << ": " << d;
      EXPECT_EQ(reference.counters.samples + reference.counters.skipped, r.counters.samples + r.counters.skipped)
          << what << " on " << targets()[t].name;
      EXPECT_EQ(reference.counters.terminated, r.counters.terminated) << what << " on " << targets()[t].name;
    } catch (const NotSupported& reason) {
      ++missing;
      std::printf("%s on %s: not supported: %s\n", what.c_str(), targets()[t].name.c_str(), reason.what());
    }
  }
}

TEST_P(Agreement, SameBitsOnEveryTarget) {
  const Volume& v = GetParam();
  if (v.file.empty()) GTEST_SKIP() << "not supported: no data (" << v.name << ")";
  double worst = 0;
  int compared = 0, missing = 0;
  for (bool shaded : {false, true}) {
    for (bool clipped : {false, true}) {
      FrameImage unskipped;
      for (bool skipping : {false, true}) {
        for (bool paged : {false, true}) {
          if (paged && skipping != shaded) continue;  // pairwise: pages with either value of the others
          json config = config_of(v, shaded, clipped, skipping);
          if (paged) config["limits"] = {{"gpu_buffer", v.page}};
          const std::string what = v.name + (shaded ? " shaded" : "") + (clipped ? " clipped" : "") +
                                   (skipping ? " skipping" : "") + (paged ? " paged" : "");
          compare_targets(config, what, worst, compared, missing);
        }
        const FrameImage image = render(config_of(v, shaded, clipped, skipping), targets().front()).image;
        if (!skipping) unskipped = image;
        EXPECT_EQ(differing_values(unskipped, image), 0u) << v.name << ": skipping changes bits";
      }
    }
  }
  std::printf("%s: worst difference %g over %d comparisons, %d not supported\n", v.name.c_str(), worst, compared,
              missing);
  EXPECT_GT(compared, 0);
}

// Skipping must skip something, or the agreement above says nothing about it.
TEST(Skipping, SkipsOnRealData) {
  const Volume engine = volumes().front();
  const FrameCounters c = render(config_of(engine, false, false, true), targets().front()).counters;
  std::printf("engine: %llu samples, %llu skipped, %llu rays terminated\n", static_cast<unsigned long long>(c.samples),
              static_cast<unsigned long long>(c.skipped), static_cast<unsigned long long>(c.terminated));
  EXPECT_GT(c.skipped, c.samples / 4);
}

// RGB extinction, tf nodes, prescribed light, jitter, orthographic camera: the variants that the volumes do not reach.
struct Variation {
  std::string name;
  json patch;
};
void PrintTo(const Variation& v, std::ostream* out) { *out << v.name; }
class AgreementOfVariations : public testing::TestWithParam<Variation> {};

TEST_P(AgreementOfVariations, SameBitsOnEveryTarget) {
  json base = {{"data",
                {{"type", "procedural"},
                 {"field", "marschner_lobb"},
                 {"size", {30, 33, 27}},
                 {"voxel_type", "int8"},
                 {"range", {0, 1}}}},
               {"optical_model",
                {{"type", "absorption_emission"},
                 {"opacity", {{0.2, 0}, {0.5, 0.1}, {0.8, 0.4}}},
                 {"color", {{0, 0.2, 0.5, 1}, {1, 1, 0.6, 0.1}}},
                 {"length_unit", "voxel"},
                 {"shaded", true}}},
               {"estimator", {{"type", "direct"}}},
               {"illumination", {{{"type", "blinn_phong"}}}},
               {"camera", {{"type", "perspective"}, {"position", {1.2, -2.0, 0.9}}, {"up", {0, 0, 1}}}},
               {"sampling", {{"type", "uniform"}, {"step", 0.61}}},
               {"image", {{"size", {50, 42}}}}};
  double worst = 0;
  int compared = 0, missing = 0;
  compare_targets(patched(base, GetParam().patch), GetParam().name, worst, compared, missing);
  std::printf("%s: worst difference %g over %d comparisons, %d not supported\n", GetParam().name.c_str(), worst,
              compared, missing);
  EXPECT_GT(compared, 0);
}

INSTANTIATE_TEST_SUITE_P(Volumes, Agreement, testing::ValuesIn(volumes()),
                         [](const auto& instance) { return instance.param.name; });
INSTANTIATE_TEST_SUITE_P(
    Variations, AgreementOfVariations,
    testing::Values(
        Variation{
            "rgb_extinction",
            {{"optical_model",
              {{"opacity", nullptr}, {"extinction", {{0.2, 0, 0, 0}, {0.6, 0.1, 0.2, 0.4}, {1, 0.9, 0.5, 0.1}}}}}}},
        Variation{"rgb_unshaded",
                  {{"optical_model",
                    {{"opacity", nullptr},
                     {"shaded", false},
                     {"extinction", {{0.2, 0, 0, 0}, {0.6, 0.1, 0.2, 0.4}, {1, 0.9, 0.5, 0.1}}}}}}},
        Variation{"tf_nodes", {{"optical_model", {{"tf", "nodes"}}}}},
        Variation{"tf_nodes_unshaded", {{"optical_model", {{"tf", "nodes"}, {"shaded", false}}}}},
        Variation{"opacity_interpolation", {{"optical_model", {{"interpolation", "opacity"}}}}},
        Variation{"emission", {{"optical_model", {{"emission", {{0, 0, 0, 0}, {1, 0.1, 0.2, 0.3}}}}}}},
        Variation{"prescribed_light",
                  {{"illumination", {{{"type", "prescribed"}, {"k1", {0.2, 0.4, 0.6}}, {"b1", {0.3, 0.1, 0}}}}}}},
        Variation{"jitter", {{"sampling", {{"jitter", 1}}}, {"seed", 12345}}},
        Variation{
            "orthographic",
            {{"camera",
              {{"type", "orthographic"}, {"position", {0.3, -2.0, 0.9}}, {"fov_deg", nullptr}, {"height", 1.7}}}}},
        Variation{"formula", {{"data", {{"evaluate", "formula"}}}}},
        Variation{"formula_radial", {{"data", {{"evaluate", "formula"}, {"field", "radial"}, {"scale", 0.6}}}}},
        Variation{"formula_sinusoid", {{"data", {{"evaluate", "formula"}, {"field", "sinusoid"}, {"omega", 9}}}}},
        Variation{"formula_polynomial", {{"data", {{"evaluate", "formula"}, {"field", "polynomial"}}}}},
        Variation{"dense", {{"optical_model", {{"opacity", {{0, 1}, {1, 1}}}}}}},
        Variation{"camera_inside", {{"camera", {{"position", {0.1, -0.2, 0.05}}}}}}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace dvrlab::test
