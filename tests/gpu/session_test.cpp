// Whole frames of the real kernels on both devices.
#include <bit>

#include "framework/config/document.h"
#include "framework/config/resolve.h"
#include "framework/interfaces/error.h"
#include "framework/scene/scene.h"
#include "tests/gpu/gpu_test.h"

namespace dvrlab {
namespace {

using namespace gpu_test;

constexpr const char* config = R"({
  "data": { "type": "procedural", "field": "marschner_lobb", "scale": 255, "voxel_type": "uint8", "size": [40, 36, 32] },
  "optical_model": { "type": "absorption_emission", "shaded": true, "length_unit": "voxel", "dl_std": 1.0,
                     "opacity": [[0, 0], [90, 0], [150, 0.2], [255, 0.6]], "color": [[0, 0.2, 0.5, 0.9], [255, 1, 0.6, 0.2]] },
  "estimator": { "type": "direct" },
  "lights": [ { "type": "head" } ],
  "illumination": [ { "type": "blinn_phong" } ],
  "camera": { "type": "perspective", "frame": "data", "position": [1.5, -2.0, 1.2], "up": [0, 0, 1], "fov_deg": 30 },
  "sampling": { "type": "uniform", "step": 0.7, "unit": "voxel" },
  "image": { "size": [70, 61], "background": [0.1, 0.2, 0.3] }
})";

/// Splits the volume into six pages, the transfer function's table into two.
const std::vector<std::string> in_small_pages{"limits.gpu_buffer=8192", "optical_model.tf_entries=128"};

Scene scene_of(const std::vector<std::string>& set = {}) {
  static const Registry registry;
  const ConfigDocument document = parse_document(config, "session_test", ".", set);
  Problems problems;
  const ResolvedCase resolved = resolve_case(document.tree, document.base_folder, registry, problems);
  problems.raise();
  return build_scene(resolved, registry, FieldCache().load(resolved, registry));
}

void expect_same_bits(const FrameImage& a, const FrameImage& b) {
  ASSERT_EQ(a.color.size(), b.color.size());
  int different = 0;
  for (std::size_t i = 0; i < a.color.size(); ++i)
    different += std::bit_cast<std::uint32_t>(a.color[i]) != std::bit_cast<std::uint32_t>(b.color[i]) ||
                 std::bit_cast<std::uint32_t>(a.trans[i]) != std::bit_cast<std::uint32_t>(b.trans[i]);
  EXPECT_EQ(different, 0) << "values that differ, of " << a.color.size();
}

FrameResult render(BackendSession& session, const FrameJob& job) {
  FrameResult result;
  session.render(job, result);
  return result;
}

class Session : public testing::TestWithParam<const char*> {};

TEST_P(Session, ShowsTheVolume) {
  DVRLAB_OPEN_OR_SKIP(session, GetParam());
  const Scene scene = scene_of();
  const FrameResult result = render(*session, scene.job);
  EXPECT_GT(result.counters.samples, 10000u);
  std::size_t opaque = 0, free = 0;
  for (const float t : result.image.trans) {
    ASSERT_TRUE(t >= 0.0f && t <= 1.0f);
    opaque += t < 0.5f;
    free += t == 1.0f;
  }
  EXPECT_GT(opaque, 100u);
  EXPECT_GT(free, 100u);
  EXPECT_NEAR(result.image.color[0], 0.1f, 1e-6f) << "the corner shows the background";
}

TEST_P(Session, BandsAndPagesDoNotChangeABit) {
  DVRLAB_OPEN_OR_SKIP(session, GetParam());
  DVRLAB_OPEN_OR_SKIP(narrow, GetParam(), {{"band_ms", "1e-6"}});
  const Scene whole = scene_of({"optical_model.tf_entries=128"}), paged = scene_of(in_small_pages);
  const FrameResult expected = render(*session, whole.job);
  const FrameResult in_bands = render(*narrow, whole.job), in_pages = render(*session, paged.job);
  expect_same_bits(expected.image, in_bands.image);
  expect_same_bits(expected.image, in_pages.image);
  EXPECT_EQ(expected.counters.samples, in_bands.counters.samples);
  EXPECT_EQ(expected.counters.samples, in_pages.counters.samples);
}

TEST_P(Session, RendersAnotherSizeAndThenTheFirstAgain) {
  DVRLAB_OPEN_OR_SKIP(session, GetParam());
  const Scene first = scene_of(), larger = scene_of({"image.size=[99,130]", "optical_model.shaded=false"});
  const FrameResult before = render(*session, first.job);
  EXPECT_EQ(render(*session, larger.job).image.height, 130);
  expect_same_bits(before.image, render(*session, first.job).image);
}

TEST_P(Session, TellsItsPhasesAndItsDevice) {
  DVRLAB_OPEN_OR_SKIP(session, GetParam());
  const Scene scene = scene_of();
  std::vector<std::string> phases;
  for (const PhaseTime& time : render(*session, scene.job).times) {
    phases.push_back(time.phase);
    EXPECT_GE(time.seconds, 0) << time.phase;
    EXPECT_LT(time.seconds, 60) << time.phase;
  }
  EXPECT_EQ(phases, (std::vector<std::string>{"upload", "compile", "march", "download"}));
  EXPECT_FALSE(session->device(Precision::strict).device.empty());
  EXPECT_GT(session->bytes_needed(scene.job), 40u * 36u * 32u);
}

TEST_P(Session, UnknownDeviceListsWhatIsThere) {
  DVRLAB_OPEN_OR_SKIP(session, GetParam());
  try {
    open(GetParam(), {{"device", "\"no such card\""}});
    FAIL() << "it was found";
  } catch (const NotSupported& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("no such card"), std::string::npos) << text;
    EXPECT_NE(text.find("0: "), std::string::npos) << text;
  }
  EXPECT_EQ(open(GetParam(), {{"device", "\"0\""}})->device(Precision::strict).api,
            session->device(Precision::strict).api);
}

INSTANTIATE_TEST_SUITE_P(Devices, Session, testing::Values("vulkan", "opengl"),
                         [](const auto& device) { return std::string(device.param); });

TEST(VulkanSession, ValidationLayersAreSilent) {
  DVRLAB_OPEN_OR_SKIP(session, "vulkan", {{"validation", "true"}});
  EXPECT_NO_THROW(render(*session, scene_of().job));
  EXPECT_NO_THROW(render(*session, scene_of(in_small_pages).job));
}

TEST(OpenGlSession, DebugOutputIsSilent) {
  DVRLAB_OPEN_OR_SKIP(session, "opengl", {{"debug", "true"}});
  EXPECT_NO_THROW(render(*session, scene_of().job));
  EXPECT_NO_THROW(render(*session, scene_of(in_small_pages).job));
}

TEST(BothDevices, SameBits) {
  DVRLAB_OPEN_OR_SKIP(vulkan, "vulkan");
  DVRLAB_OPEN_OR_SKIP(opengl, "opengl");
  for (const char* type : {"uint8", "int16", "uint16", "float32"}) {
    const Scene scene = scene_of({std::string("data.voxel_type=\"") + type + "\""});
    expect_same_bits(render(*vulkan, scene.job).image, render(*opengl, scene.job).image);
  }
}

}  // namespace
}  // namespace dvrlab
