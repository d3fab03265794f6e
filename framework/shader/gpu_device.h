// What Vulkan and OpenGL each implement: buffers, one compute program, one dispatch at a time. The frame's logic
// (composing, paging, bands, counters) is written once, in gpu_session.h.
#pragma once

#include <memory>

#include "framework/interfaces/backend.h"
#include "framework/shader/shader.h"
#include "framework/shader/spirv.h"

namespace dvrlab {

enum class BufferUse { uniform, storage, output };

/// Memory on the device; freed with the object, which must not outlive its device.
class GpuBuffer {
 public:
  explicit GpuBuffer(std::uint64_t bytes) : bytes_(bytes) {}
  virtual ~GpuBuffer() = default;
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::uint64_t bytes_;
};

struct GpuBinding {
  int binding;
  BufferUse use;
};

/// Used by one thread. Every call blocks until its work is done. Errors: NotSupported when memory is short (with
/// the sum of the bytes), std::runtime_error for everything else.
class GpuDevice {
 public:
  virtual ~GpuDevice() = default;
  virtual DeviceInfo info() const = 0;
  virtual ShaderLimits limits() const = 0;
  /// Bytes of device memory, 0 when the interface does not tell.
  virtual std::uint64_t memory() const = 0;
  /// True when the device's memory is the machine's memory.
  virtual bool shares_memory() const = 0;
  /// Called first in every frame: makes a context current.
  virtual void begin_frame() = 0;
  /// Called last in every frame. Throws std::runtime_error with what validation or debug output said since.
  virtual void end_frame() = 0;
  virtual std::unique_ptr<GpuBuffer> make_buffer(BufferUse use, std::uint64_t bytes) = 0;
  /// Fills the buffer from its start; what is beyond `bytes` becomes 0. `storage` and `uniform` only.
  virtual void write(GpuBuffer& buffer, const void* data, std::uint64_t bytes) = 0;
  virtual void read(GpuBuffer& buffer, void* data, std::uint64_t bytes) = 0;
  /// The program of the next dispatches. Forgets what was bound.
  virtual void set_program(const Spirv& spirv, const std::vector<GpuBinding>& bindings) = 0;
  virtual void bind(int binding, GpuBuffer& buffer) = 0;
  /// Returns the seconds on the device, or < 0 when it has no clock.
  virtual double dispatch(unsigned groups_x, unsigned groups_y) = 0;
};

}  // namespace dvrlab
