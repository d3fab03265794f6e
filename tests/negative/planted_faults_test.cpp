// Negative controls: a planted fault in the kernel text of one backend must break the agreement with the others.
#include <memory>

#include "tests/negative/faulty_folder.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

json config() {
  return {
      {"data", {{"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {24, 26, 22}}, {"voxel_type", "uint8"}}},
      {"optical_model",
       {{"type", "absorption_emission"},
        {"opacity", {{0, 0}, {0.4, 0.02}, {1, 0.4}}},
        {"color", {{0, 0.2, 0.5, 1}, {1, 1, 0.6, 0.1}}},
        {"length_unit", "voxel"}}},
      {"estimator", {{"type", "direct"}}},
      {"camera", {{"type", "perspective"}, {"position", {1.2, -2.0, 0.9}}, {"up", {0, 0, 1}}}},
      {"sampling", {{"type", "uniform"}, {"step", 0.61}}},
      {"image", {{"size", {48, 40}}}}};
}

/// The same medium in a mesh of tetrahedra.
json mesh_config() {
  return patched(config(), {{"data",
                             {{"type", "procedural"},
                              {"field", "marschner_lobb"},
                              {"evaluate", "mesh"},
                              {"cells", "tetrahedra6"},
                              {"size", {6, 6, 6}},
                              {"voxel_type", nullptr}}},
                            {"optical_model", {{"tf", "nodes"}}},
                            {"estimator", {{"type", "exact"}}},
                            {"sampling", {{"type", "faces"}, {"step", 100}}}});
}

struct Fault {
  std::string name, file, from, to;
  json (*scene)() = config;
};

void PrintTo(const Fault& f, std::ostream* out) { *out << f.name; }

class PlantedFault : public testing::TestWithParam<Fault> {};

TEST_P(PlantedFault, IsCaught) {
  const Fault& fault = GetParam();
  const Target cpu{"cpu", {{"type", "cpu"}}}, vulkan{"vulkan", {{"type", "vulkan"}}};
  try {
    const FrameImage right = render(fault.scene(), cpu).image;
    const FrameImage same = render(fault.scene(), vulkan).image;
    ASSERT_EQ(differing_values(right, same), 0u) << "without a fault the backends agree";
    std::unique_ptr<FaultyFolder> folder;
    const FrameImage wrong = render(fault.scene(), vulkan, [&](FrameJob& job) {
                               folder =
                                   std::make_unique<FaultyFolder>(job.kernel_folder, fault.file, fault.from, fault.to);
                               job.kernel_folder = folder->path();
                             }).image;
    std::printf("%s: largest difference %.3e in %zu values\n", fault.name.c_str(), largest_difference(right, wrong),
                differing_values(right, wrong));
    EXPECT_GT(differing_values(right, wrong), 0u);
    EXPECT_GT(largest_difference(right, wrong), 0.0);
  } catch (const NotSupported& reason) {
    GTEST_SKIP() << "not supported: " << reason.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Faults, PlantedFault,
    testing::Values(
        Fault{"wrong_step", "steps.kernel", "real s = rmax(to_real(i) * R(frame_step) - offset, R(0.0));",
              "real s = rmax(to_real(i) * R(frame_step) * R(1.0001) - offset, R(0.0));"},
        Fault{"last_segment_with_full_length", "steps.kernel", "  return length;", "  return R(frame_step);"},
        Fault{"filter_weights_of_8_bits", "volume.kernel",
              "c.f = v3(x - to_real(c.x), y - to_real(c.y), z - to_real(c.z));",
              "c.f = v3(floor((x - to_real(c.x)) * R(256.0) + R(0.5)) * R(0.00390625), y - to_real(c.y), z "
              "- to_real(c.z));"},
        Fault{"half_voxel_shift", "volume.kernel", "real x = rmin(rmax(p.x, R(0.0)), to_real(I(nx - 1)));",
              "real x = rmin(rmax(p.x + R(0.5), R(0.0)), to_real(I(nx - 1)));"},
        Fault{"face_walked_twice", "tetrahedra.kernel", "next.cell = select(m.behind >= I(0), m.behind, w.cell);",
              "next.cell = w.cell;", mesh_config},
        Fault{"segments_unsorted", "composite.kernel", "color = color + c * trans;", "color = color * rgb_of(t) + c;",
              mesh_config}),
    [](const auto& instance) { return instance.param.name; });

// A contracted multiply-add differs in the last bit only; the comparison must see it.
TEST(PlantedFault, ContractedMultiplyAddIsCaught) {
  const Target cpu{"cpu", {{"type", "cpu"}, {"isa", "avx2"}}};
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "not supported: this processor has no fused multiply-add";
  const FrameImage right = render(config(), cpu).image;
  const FrameImage wrong = render(config(), cpu, [](FrameJob& job) { job.sampler.folder = DVRLAB_CONTRACTED; }).image;
  std::printf("contracted multiply-add: largest difference %.3e in %zu values\n", largest_difference(right, wrong),
              differing_values(right, wrong));
  EXPECT_GT(differing_values(right, wrong), 0u);
  EXPECT_LT(largest_difference(right, wrong), 1e-5) << "only the rounding may differ";
}

// On a GPU it does not even reach the device.
TEST(PlantedFault, FmaIsRefusedInStrictMode) {
  const Target vulkan{"vulkan", {{"type", "vulkan"}}};
  try {
    std::unique_ptr<FaultyFolder> folder;
    EXPECT_THROW(render(config(), vulkan,
                        [&](FrameJob& job) {
                          folder = std::make_unique<FaultyFolder>(job.kernel_folder, "volume.kernel",
                                                                  "{ return a + w * (b - a); }",
                                                                  "{ return fma(w, b - a, a); }");
                          job.kernel_folder = folder->path();
                        }),
                 std::exception);
  } catch (const NotSupported& reason) {
    GTEST_SKIP() << "not supported: " << reason.what();
  }
}

}  // namespace
}  // namespace dvrlab::test
