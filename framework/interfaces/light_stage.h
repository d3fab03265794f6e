// What fills a light volume: voxel kernels in order, each reading volumes of earlier ones, and what is made of the last
// (docs/math D, docs/adr/0011). A backend runs one stage at a time.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/interfaces/blocks.h"
#include "framework/interfaces/kernel_unit.h"

namespace dvrlab {

/// A regular grid over the domain's box, both ends included: x fastest, then y, z, channel. Or `blocks`: the samples of
/// the field's blocks (BlockedField), in rows of dims[0].
struct LightGrid {
  std::array<int, 3> dims{2, 2, 2};  // each at least 2; with blocks the last is 1
  int channels = 1;                  // 1 to 4
  bool blocks = false;
  std::uint64_t points() const { return std::uint64_t(dims[0]) * std::uint64_t(dims[1]) * std::uint64_t(dims[2]); }
  std::uint64_t numbers() const { return points() * std::uint64_t(channels); }
};

/// The volume of an earlier stage as a buffer of this one's kernel. A negative stage: there is none, the kernel does
/// not read it. `placed`: the kernel knows its grid by <buffer>_nx, _ny, _nz, _lo, _scale (sampler coordinates to
/// grid).
struct StageRead {
  std::string buffer;
  int stage = -1;
  bool placed = false;
};

/// One voxel kernel: <folder>/<kernel>.kernel defines stage_voxel (framework/kernel/cpu/stage.module.cpp has the
/// contract).
struct LightStage {
  std::string kernel;
  std::string label;        // what the result's timings call it: "segment"
  std::string folder;       // the plugin's; filled in by the framework
  LightGrid grid;           // channels: one per light, or with RGB extinction one per colour of one light
  int first_light = 0;      // of LightSetting::light
  bool long_loops = false;  // a voxel may take more rounds than software GPUs grant an invocation
  std::vector<Uniform> uniforms;
  std::vector<Buffer> buffers;
  std::vector<StageRead> reads;
};

/// Light that arrives, as a part of what the light sends: the sum of these stages' volumes.
struct LightPart {
  std::vector<int> stages;  // of one grid
  int first_light = 0;      // -1: of no light: white
  bool clamp = true;        // the sum, to [0, 1]
  bool error = false;       // one light; channel 0 is the light, channel 1 its standard error
  int color = -1;           // with `error` and RGB extinction: the only channel that it lights
};

/// Numbers of the finished light volume as the march reads them: floats, or levels from 0 to 65535 of equal steps up to
/// the largest (an error of a 131070th of that at the most), half the bytes for the march to read.
enum class LightStorage { float32, unorm16 };

/// What a pass makes of its parameters.
struct LightPlan {
  std::vector<LightStage> stages;
  std::vector<LightPart> parts;
  /// Nothing, or stages whose sum is the image itself: (r, g, b, transmittance) of its pixels, dims[2] independent
  /// estimates of each. There is no march and no light volume then.
  std::vector<int> image;
  double opacity_scale = 1;  // extinction that light rays see, relative to the medium's
  double bias = 0;           // light that is always there: bias + (1 - bias) x
  double blend = 1;          // how much of all this acts: 1 - blend + blend (...)
  LightStorage storage = LightStorage::float32;
};

/// A volume in the precision of the case. fp64 has both.
struct LightVolume {
  LightGrid grid;
  std::shared_ptr<std::vector<float>> values;
  std::shared_ptr<std::vector<double>> values64;                // empty pointer unless fp64
  std::vector<std::pair<std::string, double>> statistics = {};  // FrameResult::light
  std::shared_ptr<std::vector<float>> error;  // per point: the standard error of `values`; empty pointer without
  /// With LightStorage::unorm16: `values` are these times `unit`, up to rounding. Empty pointer without.
  std::shared_ptr<std::vector<std::uint16_t>> levels = nullptr;
  float unit = 1;
};

/// Everything that fills the light volume of a frame.
struct LightWork {
  LightPlan plan;
  KernelUnit rays;                             // light_*: what all stages read (framework/kernel/light_ray.kernel)
  KernelUnit sampler;                          // the field at positions; of the frame, unless that one walks
  std::array<double, 3> lo{}, hi{};            // the box in sampler coordinates
  std::array<int, 3> dims{2, 2, 2};            // of the light volume, where it is a grid
  std::shared_ptr<const BlockedField> blocks;  // of which it has the samples else
  bool rgb = false;                            // extinction differs between channels
  std::vector<std::array<double, 3>> color;    // of each light
  std::uint64_t bytes() const;                 // of all volumes that are held at once, at the most
};

/// Planes of the light volume: 1, or 3 where lights or extinction have colours.
int light_planes(const LightWork& work);

/// The points of volumes that have the field's own: of its blocks, or of a grid.
LightGrid light_points(const std::array<int, 3>& dims, const BlockedField* blocks, int channels);

}  // namespace dvrlab
