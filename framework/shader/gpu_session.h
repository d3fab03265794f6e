// The session of every GPU backend: composes the frame's shader, keeps buffers on the device between frames,
// dispatches bands and decodes the output. The device below it is Vulkan's or OpenGL's.
#pragma once

#include <map>

#include "framework/shader/band_plan.h"
#include "framework/shader/gpu_device.h"

namespace dvrlab {

class GpuSession final : public BackendSession {
 public:
  /// `band_seconds`: the longest time that one dispatch should take.
  GpuSession(std::unique_ptr<GpuDevice> device, double band_seconds);
  DeviceInfo device(Precision) const override { return device_->info(); }
  std::uint64_t bytes_needed(const FrameJob& job) const override;

 protected:
  void march(const FrameJob& job, FrameResult& result) override;
  void fill(const StageJob& job, LightVolume& volume) override;

 private:
  /// A buffer of the job on the device. `source` knows the job's memory without keeping it: once that is freed, it
  /// equals nothing, whatever takes its address next.
  struct Resident {
    std::weak_ptr<const void> source;
    Element element;
    std::uint64_t count;
    std::uint64_t page_elements;
    std::vector<std::unique_ptr<GpuBuffer>> pages;
  };
  static bool same(const Resident& resident, const PagedBuffer& wanted);
  /// Returns whether the program is a new one.
  bool compile(const ComposedShader& shader);
  void upload(const ComposedShader& shader);
  void bind(const ComposedShader& shader);
  void march_bands(const FrameJob& job, const ComposedShader& shader, FrameResult& result);
  /// The first row of the next dispatch, and the extent of all.
  void write_band(const ComposedShader& shader, int row, int width, int height);
  int output_rows(int width, int height) const;

  std::unique_ptr<GpuDevice> device_;
  double band_seconds_;
  BandPlan plan_;
  std::string program_;  // hash of the shader that the device holds
  std::map<std::string, Resident> resident_;
  std::vector<std::unique_ptr<GpuBuffer>> uniforms_;  // the band block, then the units' blocks
  std::unique_ptr<GpuBuffer> output_;
};

}  // namespace dvrlab
