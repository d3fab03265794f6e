// Two voxel kernels in a row, the second reading the first one's volume: per instruction set through the cpu modules,
// and on the GPUs in place of the march (docs/adr/0001 says what a backend lacks for this).
#include <stdlib.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "backends/cpu/denormals.h"
#include "backends/cpu/modules.h"
#include "framework/interfaces/error.h"
#include "framework/scene/buffers.h"
#include "tests/spike/spike.h"

namespace dvrlab {
namespace {

using namespace spike;
using nlohmann::json;
namespace fs = std::filesystem;

struct Stage {
  KernelUnit unit;  // plugin = the stage's name
  std::array<int, 3> size;
};

using Volume = std::vector<float>;

Stage with_grid(Stage s) {
  s.unit.uniforms.insert(s.unit.uniforms.end(),
                         {Uniform::integer("stage_nx", s.size[0]), Uniform::integer("stage_ny", s.size[1]),
                          Uniform::integer("stage_nz", s.size[2])});
  return s;
}

template <class Real>
std::vector<Real> run_cpu(const FrameJob& job, const Stage& stage, const std::string& isa) {
  static cpu::ModuleCache modules;
  cpu::Bindings bindings;
  bindings.add(job.frame);
  bindings.add(stage.unit);
  const cpu::ModuleFrame<Real> frame(modules.get(DVRLAB_SPIKE_PLUGINS "/stage", stage.unit.plugin, isa),
                                     bindings.view(), job.rgb ? DVR_FEATURE_RGB : 0);
  const auto [nx, ny, nz] = stage.size;
  std::vector<Real> out(std::size_t(nx) * std::size_t(ny) * std::size_t(nz));
  const cpu::KeepDenormals keep;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      frame.calls().stage.fill_row(frame.state(), 0, nx, y, z, out.data() + (std::size_t(z) * ny + y) * nx);
  return out;
}

/// Kernel texts with the stage in place of the march.
class StageTexts {
 public:
  explicit StageTexts(const std::string& stage) {
    std::string name = (fs::temp_directory_path() / "dvrlab_stage_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
    fs::copy(Registry::kernel_folder(), path_, fs::copy_options::recursive);
    fs::copy_file(DVRLAB_SPIKE_SOURCE "/stage/stage.glsl", path_ / "march.glsl", fs::copy_options::overwrite_existing);
    for (const char* empty : {"none.kernel", "stream.glsl", "steps.glsl", "integrate.kernel"})
      std::ofstream(path_ / empty);
    fs::copy_file(DVRLAB_SPIKE_SOURCE "/stage/" + stage + ".kernel", path_ / (stage + ".kernel"));
  }
  ~StageTexts() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  StageTexts(const StageTexts&) = delete;
  StageTexts& operator=(const StageTexts&) = delete;
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

Volume run_gpu(FrameJob job, const Stage& stage, BackendSession& session) {
  const StageTexts texts(stage.unit.plugin);
  job.kernel_folder = texts.path();
  job.sampler = {};
  job.sampler.plugin = "none";
  job.estimator = stage.unit;
  job.sampler.folder = job.estimator.folder = texts.path();
  job.width = stage.size[0];
  job.height = stage.size[1] * stage.size[2];
  FrameResult result;
  session.render(job, result);
  Volume out(std::size_t(job.width) * std::size_t(job.height));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = result.image.color[3 * i];
  return out;
}

Scene lit_scene(const std::string& voxel_type, bool rgb, double tau) {
  json config = json::parse(R"({
    "data": { "type": "procedural", "field": "marschner_lobb", "size": [37, 33, 29] },
    "optical_model": { "type": "absorption_emission", "shaded": true, "length_unit": "voxel",
                       "extinction": [[0, 0], [0.3, 0], [0.6, 0.4], [1, 0.1]], "color": [[0, 1, 1, 1]] },
    "estimator": { "type": "direct" },
    "lights": [ { "type": "head" } ], "illumination": [ { "type": "blinn_phong" } ],
    "camera": { "type": "perspective", "frame": "data", "position": [1.5, -2.0, 1.2], "up": [0, 0, 1] },
    "sampling": { "type": "uniform", "step": 1, "unit": "voxel" }, "image": { "size": [8, 8] } })");
  config["data"]["voxel_type"] = voxel_type;
  if (voxel_type != "float32") config["data"]["range"] = {0, 1};
  if (rgb)
    config["optical_model"]["extinction"] = json::parse("[[0,0,0,0],[0.3,0,0,0],[0.6,0.4,0.2,0.1],[1,0.1,0.1,0.1]]");
  if (tau > 0) config["optical_model"]["extinction"] = {{0, tau}, {1, tau}};
  return scene_of(config.dump());
}

constexpr int samples = 8, segments = 5;
constexpr double reach = 4.0;  // of a short segment, voxels

Stage local_stage(const Scene& scene, std::array<int, 3> size) {
  const auto& grid = dynamic_cast<const GridField&>(*scene.field);
  Stage s;
  s.size = size;
  s.unit.plugin = "spike_local";
  s.unit.buffers = {scene.job.sampler.buffers.at(0)};
  s.unit.buffers[0].name = "spike_local_field";
  const double d = reach / samples;
  std::array<double, 3> scale;
  for (std::size_t c = 0; c < 3; ++c) scale[c] = double(grid.dims[c] - 1) / (size[c] - 1);
  s.unit.uniforms = {Uniform::integer("spike_local_nx", grid.dims[0]),
                     Uniform::integer("spike_local_ny", grid.dims[1]),
                     Uniform::integer("spike_local_nz", grid.dims[2]),
                     Uniform::vector("spike_local_scale", scale[0], scale[1], scale[2]),
                     Uniform::vector("spike_local_toward", 0.48 * d, 0.6 * d, 0.64 * d),
                     Uniform::integer("spike_local_samples", samples),
                     Uniform::real("spike_local_ds", grid.voxel * d)};
  return with_grid(s);
}

Stage global_stage(const Volume& local, std::array<int, 3> size) {
  Stage s;
  s.size = size;
  s.unit.plugin = "spike_global";
  s.unit.buffers = {make_buffer("spike_global_local", Element::f32, local, local.size())};
  s.unit.uniforms = {Uniform::integer("spike_global_nx", size[0]), Uniform::integer("spike_global_ny", size[1]),
                     Uniform::integer("spike_global_nz", size[2]),
                     Uniform::vector("spike_global_toward", 0.48 * reach, 0.6 * reach, 0.64 * reach),
                     Uniform::integer("spike_global_segments", segments)};
  return with_grid(s);
}

std::size_t different_bits(const Volume& a, const Volume& b) {
  std::size_t n = a.size() == b.size() ? 0 : a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    n += std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i]);
  return n;
}

/// Both stages on every target; returns the first target's volumes.
std::array<Volume, 2> run_everywhere(const std::string& what, const Scene& scene, std::array<int, 3> size) {
  EXPECT_TRUE(scene.job.full) << "stages see the full medium";
  std::array<Volume, 2> first;
  for (const Target& target : targets()) {
    if (!target.session) continue;
    const auto run = [&](const Stage& stage) {
      return target.name.starts_with("cpu ") ? run_cpu<float>(scene.job, stage, target.name.substr(4))
                                             : run_gpu(scene.job, stage, *target.session);
    };
    const auto start = std::chrono::steady_clock::now();
    const Volume local = run(local_stage(scene, size));
    const Volume global = run(global_stage(local, size));
    const double ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (first[0].empty()) first = {local, global};
    const std::size_t n = different_bits(first[0], local) + different_bits(first[1], global);
    std::printf("%-20s %-10s %8.1f ms wall, %zu voxels, %zu differ\n", what.c_str(), target.name.c_str(), ms,
                2 * local.size(), n);
    EXPECT_EQ(n, 0u) << what << " on " << target.name;
  }
  return first;
}

TEST(SpikeStage, SameBitsForEveryVoxelType) {
  for (const char* type : {"uint8", "int8", "uint16", "int16", "float32"}) {
    const auto volumes = run_everywhere(std::string("stages, ") + type, lit_scene(type, false, 0), {37, 33, 29});
    EXPECT_NE(*std::max_element(volumes[0].begin(), volumes[0].end()), 0.0f);
    EXPECT_NE(*std::min_element(volumes[1].begin(), volumes[1].end()), 1.0f);
  }
  run_everywhere("stages, rgb medium", lit_scene("uint8", true, 0), {37, 33, 29});
  run_everywhere("stages, coarse grid", lit_scene("uint8", false, 0), {10, 9, 8});
}

// A homogeneous medium: 1 - e^(-tau reach) everywhere, then its power on the way through the box.
TEST(SpikeStage, Homogeneous) {
  const double tau = 0.11;
  const auto [local, global] = run_everywhere("stages, constant", lit_scene("float32", false, tau), {37, 33, 29});
  for (const float a : local) ASSERT_NEAR(a, 1 - std::exp(-tau * reach), 1e-6);
  EXPECT_NEAR(global.front(), std::exp(-tau * reach * segments), 2e-6) << "all segments inside";
  EXPECT_NEAR(global.back(), std::exp(-tau * reach), 2e-6) << "the corner at the light: the first segment only";
}

// Both stages in double: the second one reads the first one's volume in double.
TEST(SpikeStage, InFp64) {
  const std::array<int, 3> size{37, 33, 29};
  const auto run = [&](const Scene& scene) {
    const std::vector<double> local = run_cpu<double>(scene.job, local_stage(scene, size), cpu::fp64_isa);
    Stage global = global_stage(Volume(local.begin(), local.end()), size);
    EXPECT_THROW(run_cpu<double>(scene.job, global, cpu::fp64_isa), InputError) << "a volume without fp64 values";
    const auto owner = std::make_shared<std::vector<double>>(local);
    global.unit.buffers[0].data64 = {owner, owner->data()};
    return std::array{local, run_cpu<double>(scene.job, global, cpu::fp64_isa)};
  };
  const double tau = 0.11;
  const auto constant = run(lit_scene("float32", false, tau));
  double worst = std::fabs(constant[1].front() - std::exp(-tau * reach * segments));
  for (const double a : constant[0]) worst = std::max(worst, std::fabs(a - (1 - std::exp(-tau * reach))));
  std::printf("stages in fp64, constant: worst error %.3g, bound 1e-14\n", worst);
  EXPECT_LE(worst, 1e-14);

  const Scene scene = lit_scene("uint8", false, 0);
  const auto fp64 = run(scene);
  const Volume fp32 = run_cpu<float>(scene.job, local_stage(scene, size), "scalar");
  double difference = 0;
  for (std::size_t k = 0; k < fp32.size(); ++k)
    difference = std::max(difference, std::fabs(double(fp32[k]) - fp64[0][k]));
  std::printf("stages in fp64, a grid: at most %.3g from fp32\n", difference);
  EXPECT_LE(difference, 1e-4);
  EXPECT_GT(difference, 1e-9) << "the comparison does not see fp32";
}

}  // namespace
}  // namespace dvrlab
