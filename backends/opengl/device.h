// OpenGL as a GpuDevice.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "backends/opengl/egl_context.h"
#include "framework/shader/gpu_device.h"
#include "framework/shader/recent.h"

namespace dvrlab {

/// A compute program of the current context.
class GlProgram {
 public:
  /// Throws std::runtime_error with the driver's log.
  GlProgram(const GlFunctions& gl, const Spirv& spirv);
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;
  GLuint name() const { return name_; }

 private:
  const GlFunctions& gl_;
  GLuint name_;
};

class GlDevice final : public GpuDevice {
 public:
  GlDevice(const std::string& device, bool debug);
  ~GlDevice() override;
  DeviceInfo info() const override;
  ShaderLimits limits() const override { return limits_; }
  std::uint64_t memory() const override { return 0; }
  /// OpenGL does not tell; counting the buffers is the careful answer.
  bool shares_memory() const override { return true; }
  void begin_frame() override;
  void end_frame() override;
  std::unique_ptr<GpuBuffer> make_buffer(BufferUse use, std::uint64_t bytes) override;
  void write(GpuBuffer& buffer, const void* data, std::uint64_t bytes) override;
  void read(GpuBuffer& buffer, void* data, std::uint64_t bytes) override;
  void set_program(const Spirv& spirv, const std::vector<GpuBinding>& bindings) override;
  void bind(int binding, GpuBuffer& buffer) override;
  double dispatch(unsigned groups_x, unsigned groups_y) override;

 private:
  /// Throws when OpenGL has noted an error: NotSupported for memory, with the bytes in use.
  void check(const char* what);
  std::unique_ptr<EglContext> context_;
  const GlFunctions& gl_;
  ShaderLimits limits_;
  std::vector<std::string> messages_;
  std::uint64_t allocated_ = 0;
  RecentPrograms<std::unique_ptr<GlProgram>> programs_;
  GLuint program_ = 0;  // of them
  GLuint queries_[2] = {0, 0};
  bool has_clock_ = false;
};

}  // namespace dvrlab
