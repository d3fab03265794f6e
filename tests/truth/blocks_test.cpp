// Blocks of their own level of detail (flat blocking): the grid itself at 1:1, continuous where levels meet, as small
// as asked, and light that misses nothing behind what was dropped.
#include <gtest/gtest.h>

#include "tests/support/plates.h"
#include "tests/truth/truth_test.h"

namespace dvrlab::test {
namespace {

/// Every block contributes something, and some more than others.
json smooth() {
  return {{"data", {{"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {53, 48, 40}}}},
          {"optical_model",
           {{"type", "absorption_emission"},
            {"length_unit", "voxel"},
            {"opacity", {{0, 0.001}, {0.45, 0.01}, {0.5, 0.3}, {0.55, 0.01}, {1, 0.001}}},
            {"color", {{0, 1, 0.8, 0.5}, {1, 0.2, 0.7, 1}}}}},
          {"estimator", {{"type", "preintegrated"}, {"table_size", 128}}},
          {"lights", {{{"type", "directional"}, {"direction", {1, 0.3, 0.8}}}}},
          {"camera", {{"type", "perspective"}, {"position", {1.2, -2.0, 0.9}}, {"up", {0, 0, 1}}}},
          {"sampling", {{"type", "uniform"}, {"step", 0.61}, {"termination", 0}}},
          {"image", {{"size", {40, 36}}}}};
}
json blocks(const json& more) { return patched({{"type", "flat_blocking"}}, more); }

class Blocks : public testing::TestWithParam<Target> {};

TEST_P(Blocks, AtOneToOneAreTheGrid) {
  const std::vector<json> passes = {
      json::array(),
      {{{"type", "blinn_phong"}}},
      {{{"type", "local_piecewise"}, {"radius", 5}, {"samples", 3}, {"segment", 5}, {"shadow_ratio", {3, 2, 4}}}},
      {{{"type", "local_piecewise"}, {"normalisation", "physical"}, {"orders", 2}, {"samples", 3}}},
      {{{"type", "blinn_phong"}}, {{"type", "shadow_full"}}},
      {{{"type", "local_ambient_occlusion"}, {"radius", 5}, {"samples", 3}}}};
  const int sides[] = {8, 16, 32};
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const json& pass = passes[k];
    json config = smooth();
    config["illumination"] = pass;
    config["optical_model"]["shaded"] = !pass.empty() && pass[0]["type"] == "blinn_phong";
    config["sampler"] = blocks({{"reduction", 1}, {"block", sides[k % 3]}});
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage whole = render(config, GetParam()).image;
      config.erase("sampler");
      EXPECT_EQ(differing_values(whole, render(config, GetParam()).image), 0u) << pass.dump();
    })
  }
}

/// The largest step of the value along rays that cross many faces of blocks, in units of what the grid has.
double jump(const json& sampler) {
  double worst = 0;
  json config = smooth();
  config["sampler"] = sampler;
  config["sampling"] = {{"type", "uniform"}, {"step", 0.02}, {"unit", "voxel"}, {"termination", 0}};
  config["optical_model"]["opacity"] = {{0, 1e-5}, {0.45, 1e-5}, {0.5, 0.003}, {0.55, 1e-5}, {1, 1e-5}};
  config["estimator"] = {{"type", "direct"}};
  for (int pixel = 0; pixel < 12; ++pixel) {
    const std::vector<ProbeSegment> ray = probe(config, 12 + pixel, 10 + pixel);
    EXPECT_GT(ray.size(), 500u);
    for (std::size_t k = 1; k < ray.size(); ++k) worst = std::max(worst, std::abs(ray[k].value - ray[k - 1].value));
  }
  return worst;
}

TEST(BlockBorders, InterblockHasNoSeamAndClampHas) {
  const double grid = jump({{"type", "grid"}});
  const double interblock = std::max(jump(blocks({{"reduction", 4}})), jump(blocks({{"reduction", 4}, {"block", 8}})));
  const double clamp = jump(blocks({{"reduction", 4}, {"block_border", "clamp"}}));
  std::printf("largest step of the value over 0.02 voxels: grid %.2e, interblock %.2e, clamp %.2e\n", grid, interblock,
              clamp);
  EXPECT_LT(interblock, 1.5 * grid);
  EXPECT_GT(clamp, 5 * grid) << "the negative control: blocks that end for themselves have seams";
}

TEST(BlockReduction, IsWhatWasAskedFor) {
  double before = 0;
  for (const double wanted : {2.0, 8.9, 14.8, 22.1, 35.2}) {
    json config = smooth();
    config["sampler"] = blocks({{"reduction", wanted}});
    const Scene s = scene_of(config);
    const auto value = [&](const std::string& name) {
      for (const auto& [key, x] : s.blocks)
        if (key == name) return x;
      throw std::logic_error(name);
    };
    std::printf("%5.1f: 1 sample for %.2f grid points, error %.3f, bytes %.0f\n", wanted, value("reduction"),
                value("error_rms"), value("bytes"));
    EXPECT_GE(value("reduction"), wanted);
    EXPECT_LE(value("reduction"), 1.1 * wanted) << "and no more than blocks of whole levels ask for";
    EXPECT_GT(value("error_rms"), before);
    before = value("error_rms");
  }
}

TEST(BlockTolerance, BoundsTheError) {
  for (const double tolerance : {0.0, 0.5, 2.0, 8.0}) {
    json config = smooth();
    config["sampler"] = blocks({{"levels", "tolerance"}, {"tolerance", tolerance}});
    const Scene s = scene_of(config);
    for (const auto& [key, x] : s.blocks) {
      if (key == "error_rms") {
        EXPECT_LE(x, tolerance);
      }
    }
  }
}

// Images come near those of the grid, and nearer the more is kept.
TEST_P(Blocks, ErrorFallsWithWhatIsKept) {
  json config = smooth();
  config["illumination"] = {{{"type", "local_piecewise"}, {"components", "direct"}, {"shadow_ratio", {2, 2, 2}}}};
  SKIP_WHEN_NOT_SUPPORTED({
    const FrameImage whole = render(config, GetParam()).image;
    double before = 1e300;
    for (const double reduction : {16.0, 4.0, 1.5}) {
      config["sampler"] = blocks({{"reduction", reduction}});
      const FrameImage image = render(config, GetParam()).image;
      double square = 0;
      for (std::size_t k = 0; k < image.color.size(); ++k) {
        const double d = double(image.color[k]) - double(whole.color[k]);
        square += d * d;
      }
      const double rms = std::sqrt(square / double(image.color.size()));
      EXPECT_LT(rms, 0.8 * before) << reduction;
      before = rms;
    }
    EXPECT_LT(before, 0.02);
  })
}

TEST_P(Blocks, SkippingChangesNoBit) {
  for (const auto& [border, side] :
       {std::pair{"interblock", 8}, {"interblock", 16}, {"interblock", 32}, {"clamp", 8}, {"clamp", 32}}) {
    json config = plates();
    config["sampler"] = blocks({{"reduction", 6}, {"block_border", border}, {"block", side}});
    config["estimator"] = {{"type", "preintegrated"}, {"table_size", 128}};
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameResult skipped = render(config, GetParam());
      // Two large blocks leave no empty macrocell.
      if (side != 32) {
        EXPECT_GT(skipped.counters.skipped, 0u) << border << " " << side;
      }
      config["sampling"]["skipping"] = false;
      EXPECT_EQ(differing_values(skipped.image, render(config, GetParam()).image), 0u) << border;
    })
  }
}

// Figure 4 of Hernell et al. 2008: a thin plate behind a dropped block keeps its shadow.
TEST_P(Blocks, LightAdvancesThroughDroppedBlocks) {
  json config = plates();
  SKIP_WHEN_NOT_SUPPORTED({
    const double with_grid = light_behind_the_plate(illuminate(config, GetParam()), nullptr);
    config["sampler"] = blocks({{"levels", "tolerance"}, {"tolerance", 0}});
    const LightVolume light = illuminate(config, GetParam());
    const Scene scene = scene_of(config);
    ASSERT_GT(scene.job.light->blocks->statistics[3].second, 0) << "no block was dropped";
    EXPECT_LT(light.values->size(), 64u * 32u * 32u * 2 / 3);
    const double with_blocks = light_behind_the_plate(light, scene.job.light->blocks.get());
    std::printf("light behind the plate: grid %.4f, blocks %.4f\n", with_grid, with_blocks);
    EXPECT_LT(with_grid, 0.5);
    EXPECT_NEAR(with_blocks, with_grid, 0.01);
  })
}

// Samples that lie on faces towards coarser blocks hold what those say there.
TEST(BlockBorders, LightConformsToo) {
  json config = smooth();
  config["sampler"] = blocks({{"reduction", 4}});
  config["illumination"] = {{{"type", "local_piecewise"}, {"components", "direct"}}};
  const LightVolume light = illuminate(config, targets().front());
  const Scene scene = scene_of(config);
  std::vector<float> again = *light.values;
  conform(*scene.job.light->blocks, again.data());
  EXPECT_EQ(again, *light.values);
  for (std::size_t k = 0; k < again.size(); ++k) again[k] = float(k % 7);
  const std::vector<float> noise = again;
  conform(*scene.job.light->blocks, again.data());
  EXPECT_NE(again, noise) << "no two levels meet: the test shows nothing";
}

TEST(BlockInput, WhatCannotBeIsRefusedByName) {
  const auto refused = [](const json& change, const char* key, const char* word) {
    json config = smooth();
    config["sampler"] = blocks({{"reduction", 2}});
    try {
      scene_of(patched(config, change));
      ADD_FAILURE() << change.dump();
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(key), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  refused({{"sampler", {{"block", 12}}}}, "sampler.block", "8, 16 or 32");
  refused({{"sampler", {{"reduction", 0.5}}}}, "sampler.reduction", "[1,500]");
  refused({{"data", {{"evaluate", "formula"}}}}, "sampler.type", "voxel grids");
  refused({{"data", {{"evaluate", "mesh"}, {"size", {5, 5, 5}}}}}, "sampler.type", "voxel grids");
}

INSTANTIATE_TEST_SUITE_P(Targets, Blocks, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
