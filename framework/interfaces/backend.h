// A backend runs the march over all pixels. It sees kernels, uniforms and buffers: nothing of optical models,
// file formats or the config.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/interfaces/kernel_unit.h"
#include "framework/interfaces/light_stage.h"
#include "framework/interfaces/plugin.h"

namespace dvrlab {

/// The key `precision`, in the order of its words. strict: fp32, same bits everywhere. fast: fp32, contraction is
/// allowed. fp64: the same kernels in double (docs/adr/0006).
enum class Precision { strict, fast, fp64 };

/// One frame, fully resolved. The kernel's uniforms lie in the units.
struct FrameJob {
  int width = 0, height = 0;
  bool rgb = false;   // extinction differs between channels
  bool full = false;  // needs more than extinction and unshaded source
  Precision precision = Precision::strict;
  KernelUnit frame;  // camera, sampling, lights, medium; kernel texts of framework/kernel
  KernelUnit sampler;
  KernelUnit estimator;
  std::string kernel_folder;               // framework/kernel
  std::shared_ptr<const LightWork> light;  // nothing: no pass fills a light volume
  /// Fetches of four numbers from transfer function and estimator tables per segment, at the most; a segment that the
  /// estimator divides counts as one part.
  int table_fetches = 0;
  /// Bytes of one storage buffer binding on a GPU, when lower than what the device offers; 0: the device's own.
  std::uint64_t gpu_buffer_limit = 0;
};

/// One stage of a light volume, with the field that its kernel asks.
struct StageJob {
  LightGrid grid;
  bool rgb = false;
  Precision precision = Precision::strict;
  KernelUnit rays, sampler, stage;  // stage: the kernel's place, stage_*, and what it reads
  bool long_loops = false;          // LightStage::long_loops
  std::string kernel_folder;
  std::uint64_t gpu_buffer_limit = 0;
};

/// Row 0 is the top row. A frame in fp64 has its numbers in double too, and `color`, `trans` are those rounded.
struct FrameImage {
  int width = 0, height = 0;
  std::vector<float> color;                        // 3 per pixel: radiance including T * background
  std::vector<float> trans;                        // 3 per pixel: transmittance
  std::vector<double> color64 = {}, trans64 = {};  // the same in fp64; empty for other precisions

  /// Number i of `color` or `trans` in the best precision that there is.
  double radiance(std::size_t i) const { return color64.empty() ? static_cast<double>(color[i]) : color64[i]; }
  double transmittance(std::size_t i) const { return trans64.empty() ? static_cast<double>(trans[i]) : trans64[i]; }
};

struct FrameCounters {
  std::uint64_t samples = 0;  // segments that were composited
  /// Fetches of four numbers from transfer function and estimator tables, at the most: FrameJob::table_fetches per
  /// sample, set by who renders the case.
  std::uint64_t table_fetches = 0;
  std::uint64_t skipped = 0;     // segments skipped as empty
  std::uint64_t terminated = 0;  // rays ended by early termination
};

struct PhaseTime {
  std::string phase;
  double seconds;      // wall time
  double cpu_seconds;  // user + system time of the process; < 0 when not measured
};

struct FrameResult {
  FrameImage image;
  FrameCounters counters;
  std::vector<PhaseTime> times;
  /// Of the light volume, over its points: "min", "max", "mean", "deviation"; where its pass knows a standard error,
  /// the root of its mean square and the largest: "error_rms", "error_max". Empty without a light volume. Of a pass
  /// that finds the image itself only those two, of its radiance.
  std::vector<std::pair<std::string, double>> light;
};

/// What runs the frames, for the result file.
struct DeviceInfo {
  std::string device, driver, api;
  std::string detail;  // instruction set and threads; or the limits that were used
};

/// One segment of a probed ray, as the estimator saw it and what it made of it.
struct ProbeSegment {
  int index = 0;
  double s = 0;       // arc length from the entry point to the sample: the centre, or with `ends` the back end
  double length = 0;  // world units
  double value = 0;   // stored value there
  std::array<double, 3> color{}, trans{};                // of the segment: radiance and transmittance
  std::array<double, 3> color_behind{}, trans_behind{};  // of the ray, after this segment; without background
};

/// Light volumes that a session has filled, kept for the next frame. What is the same is not computed again.
class LightCache;

/// A backend that is ready to render: device open, options fixed. Used by one thread.
class BackendSession {
 public:
  BackendSession();
  virtual ~BackendSession();
  BackendSession(const BackendSession&) = delete;
  BackendSession& operator=(const BackendSession&) = delete;
  /// What runs frames of this precision.
  virtual DeviceInfo device(Precision precision) const = 0;
  /// Bytes on top of the job's buffers that render() will allocate.
  virtual std::uint64_t bytes_needed(const FrameJob& job) const = 0;
  /// Fills the job's light volume, if it has one: stages whose input changed since the last call, no other; their times
  /// stand before the march's ("light <stage>", 0 for those that were kept). Then march().
  void render(const FrameJob& job, FrameResult& result);
  /// The light volume alone, as render() fills it.
  LightVolume illuminate(const FrameJob& job, std::vector<PhaseTime>& times);
  /// Every composited segment of the ray of pixel (x, y). Backends without it throw NotSupported: the cpu has it, and
  /// all backends march the same bits.
  std::vector<ProbeSegment> probe(const FrameJob& job, int x, int y);

 protected:
  /// Uploads and compiles what changed since the last call, renders, blocks until done. The job's light volume is one
  /// of its buffers.
  virtual void march(const FrameJob& job, FrameResult& result) = 0;
  virtual std::vector<ProbeSegment> march_ray(const FrameJob& job, int x, int y);
  /// Fills `volume`, whose grid and memory are there. Backends without it throw NotSupported.
  virtual void fill(const StageJob& job, LightVolume& volume);

 private:
  static FrameJob lit(const FrameJob& job, const LightVolume& volume);
  /// Of a pass that finds the image itself (LightPlan::image).
  void find_image(const FrameJob& job, FrameResult& result);
  std::unique_ptr<LightCache> light_;
};

/// One device that a backend can run on, for `dvrlab doctor`.
struct DeviceReport {
  std::string name, driver, api;
  bool software = false;  // a CPU that plays a GPU
  std::vector<std::pair<std::string, std::string>>
      property;  // limits that matter, in words: {"storage buffer", "128 MiB"}
};

/// What `dvrlab doctor` says of a backend.
struct BackendReport {
  std::vector<DeviceReport> device;
  std::string problem;  // why no device can be used, one sentence; "" when one can
  std::string package;  // the Debian package that has what is missing; "" when that is not what is wrong
};

class BackendPlugin : public Plugin {
 public:
  /// Devices, drivers and limits. Never throws for a missing library, driver or device: that is `problem`. A backend
  /// that reports nothing is tried by `open`.
  virtual BackendReport report() const { return {}; }
  /// Why frames of this precision cannot be rendered with these parameters, as a clause behind the backend's name that
  /// says what would be right; "" when they can.
  virtual std::string refuses(Precision precision, const ParameterSet& /*parameters*/) const {
    if (precision != Precision::fp64) return "";
    return "has no \"fp64\" arithmetic: kernels are compiled in double for the cpu only; set backend.type to \"cpu\", "
           "or use \"strict\"";
  }
  /// Throws NotSupported with the reason (no device, no driver, instruction set missing).
  virtual std::unique_ptr<BackendSession> open(const ParameterSet& parameters,
                                               const std::string& plugin_folder) const = 0;
};

}  // namespace dvrlab
