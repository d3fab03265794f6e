// Negative controls of blocks: faults planted into their kernels on one backend.
#include <cmath>
#include <memory>

#include "tests/negative/faulty_folder.h"
#include "tests/support/plates.h"

namespace dvrlab::test {
namespace {

const Target vulkan{"vulkan", {{"type", "vulkan"}}};

// Figure 4 of Hernell et al. 2008, left: rays that come to a dropped block go on by whole segments, and miss the plate.
TEST(BlockFault, RaysThatDoNotAdvanceMissThePlate) {
  nlohmann::json config = plates();
  config["sampler"] = {{"type", "flat_blocking"}, {"levels", "tolerance"}, {"tolerance", 0}};
  try {
    const Scene scene = scene_of(config);
    const BlockedField* blocks = scene.job.light->blocks.get();
    const double right = light_behind_the_plate(illuminate(config, vulkan), blocks);
    std::unique_ptr<FaultyFolder> folder;
    const LightVolume light = illuminate(config, vulkan, nullptr, [&](FrameJob& job) {
      folder = std::make_unique<FaultyFolder>(job.light->plan.stages[0].folder, "local_piecewise_shadow.kernel",
                                              "if (any_lane(!c.there)) {", "if (any_lane(s < R(0.0))) {");
      auto work = std::make_shared<LightWork>(*job.light);
      for (LightStage& s : work->plan.stages) s.folder = folder->path();
      job.light = work;
    });
    const double wrong = light_behind_the_plate(light, blocks);
    std::printf("light behind the plate: %.4f, without advancing %.4f\n", right, wrong);
    EXPECT_GT(wrong, right + 0.1);
  } catch (const NotSupported& reason) {
    GTEST_SKIP() << "not supported: " << reason.what();
  }
}

// A block that ends before its last cell: a seam, which the comparison with the grid finds.
TEST(BlockFault, ASeamAtABlocksBorderIsFound) {
  nlohmann::json config = plates();
  config["illumination"] = nlohmann::json::array();
  config["data"] = {{"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {40, 40, 40}}};
  config["optical_model"]["opacity"] = {{0, 0.01}, {1, 0.1}};
  config["sampler"] = {{"type", "flat_blocking"}, {"reduction", 1}};
  try {
    const FrameImage right = render(config, vulkan).image;
    std::unique_ptr<FaultyFolder> folder;
    const FrameImage wrong = render(config, vulkan, [&](FrameJob& job) {
                               folder = std::make_unique<FaultyFolder>(job.kernel_folder, "blocks.kernel", "  a.f = f;",
                                                                       "  a.f = select(a.i == I(15), R(0.0), f);");
                               job.kernel_folder = folder->path();
                             }).image;
    EXPECT_GT(largest_difference(right, wrong), 1e-3);
    config.erase("sampler");
    EXPECT_EQ(differing_values(right, render(config, vulkan).image), 0u);
  } catch (const NotSupported& reason) {
    GTEST_SKIP() << "not supported: " << reason.what();
  }
}

}  // namespace
}  // namespace dvrlab::test
