// Negative controls: faults that were printed, planted into the kernels of light on one backend.
#include <algorithm>
#include <cmath>
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
        {"extinction", {{0, 0.02}, {0.4, 0.1}, {1, 0.3}}},
        {"color", {{0, 1, 1, 1}}},
        {"length_unit", "voxel"}}},
      {"estimator", {{"type", "direct"}}},
      {"lights", {{{"type", "directional"}, {"direction", {1, 0.4, 0.8}}}}},
      {"illumination",
       {{{"type", "local_piecewise"}, {"phase", "henyey_greenstein"}, {"g", 0.6}, {"samples", 4}, {"segment", 4}}}},
      {"camera", {{"type", "perspective"}, {"position", {1.2, -2.0, 0.9}}, {"up", {0, 0, 1}}}},
      {"sampling", {{"type", "uniform"}, {"step", 1}}},
      {"image", {{"size", {16, 16}}}}};
}

struct Fault {
  std::string name;
  std::string kernel;  // file; a stage's, or the framework's
  std::string from, to;
};
void PrintTo(const Fault& f, std::ostream* out) { *out << f.name; }

class LightFault : public testing::TestWithParam<Fault> {};

double largest(const LightVolume& a, const LightVolume& b) {
  double worst = 0;
  for (std::size_t k = 0; k < a.values->size(); ++k)
    worst = std::max(worst, std::abs(double((*a.values)[k]) - double((*b.values)[k])));
  return worst;
}

TEST_P(LightFault, IsCaught) {
  const Fault& fault = GetParam();
  const Target cpu{"cpu", {{"type", "cpu"}}}, vulkan{"vulkan", {{"type", "vulkan"}}};
  try {
    const LightVolume right = illuminate(config(), cpu);
    ASSERT_EQ(*right.values, *illuminate(config(), vulkan).values) << "without a fault the backends agree";
    std::unique_ptr<FaultyFolder> folder;
    const LightVolume wrong = illuminate(config(), vulkan, nullptr, [&](FrameJob& job) {
      const bool framework = fault.kernel == "light_ray.kernel";
      folder = std::make_unique<FaultyFolder>(framework ? job.kernel_folder : job.light->plan.stages[0].folder,
                                              fault.kernel, fault.from, fault.to);
      if (framework) job.kernel_folder = folder->path();
      auto work = std::make_shared<LightWork>(*job.light);
      for (LightStage& s : work->plan.stages)
        if (!framework) s.folder = folder->path();
      job.light = work;
    });
    std::printf("%s: largest difference of the light %.3e\n", fault.name.c_str(), largest(right, wrong));
    EXPECT_GT(largest(right, wrong), 1e-3);
  } catch (const NotSupported& reason) {
    GTEST_SKIP() << "not supported: " << reason.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Faults, LightFault,
    testing::Values(
        // Equation 6 of Hernell et al. 2008 as printed: the product over samples 0 .. N has N + 1 factors.
        Fault{"printed_range_of_a_segment", "light_ray.kernel", "for (int i = 0; i < count; ++i) {",
              "for (int i = 0; i <= count; ++i) {"},
        // Equation 11: the sum over m = 0 .. M.
        Fault{"printed_range_of_a_direction", "local_piecewise_scatter.kernel", "m < local_piecewise_scatter_samples;",
              "m <= local_piecewise_scatter_samples;"},
        // Equation 13: 1 / j whatever the weights are.
        Fault{"unweighted_blend", "local_piecewise_scatter.kernel",
              "mean = mean + (along - mean) * light_four(w.x * rcp(total.x),",
              "mean = mean + (along - mean) * light_four(rcp(to_real(I(j + 1))),"},
        Fault{"own_opacity_twice", "local_piecewise_scatter.kernel", "way = depth + part * R(0.5);",
              "way = depth + part;"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace dvrlab::test
