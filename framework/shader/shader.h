// A frame's shader as text, with the places of everything that it reads. Composed from a FrameJob (compose.h),
// compiled to SPIR-V (compile.h), run by a GpuDevice (gpu_device.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/interfaces/kernel_unit.h"

namespace dvrlab {

/// The flavour of SPIR-V. Vulkan numbers all bindings in one space, OpenGL each kind of resource in its own.
enum class ShaderTarget { vulkan, opengl };

/// What a strict shader asks of a device's arithmetic, where the device offers it (SPV_KHR_float_controls). The
/// values are SPIR-V's execution modes.
enum class FloatMode : std::uint32_t {
  denorm_preserve = 4459,
  signed_zero_inf_nan_preserve = 4461,
  rounding_rte = 4462
};

/// What a device can bind, and the float modes that it offers for 32 bits.
struct ShaderLimits {
  ShaderTarget target = ShaderTarget::vulkan;
  std::uint64_t buffer_range = 0;   // bytes of one storage buffer
  std::uint64_t uniform_range = 0;  // bytes of one uniform block
  int storage_buffers = 0;          // of the compute stage
  bool runs_both_branches = false;  // a software GPU: what a branch leaves out costs as much as what it takes
  std::vector<FloatMode> float_modes;
};

/// A std140 block. `bytes` holds the job's values.
struct UniformBlock {
  struct Member {
    std::string name;
    std::uint32_t offset;
  };
  std::string name;
  int binding = 0;
  std::vector<Member> members;
  std::vector<std::byte> bytes;
};

/// A part of a buffer that is bound as one storage buffer. `allocated` >= `bytes`: the rest is zero, so that the
/// element after the last one may be read.
struct BufferPage {
  int binding = 0;
  std::uint64_t offset = 0, bytes = 0, allocated = 0;
};

struct PagedBuffer {
  Buffer buffer;
  std::uint64_t page_elements = 0;  // a power of two; used only when there is more than one page
  std::vector<BufferPage> pages;
};

/// `output` is a storage buffer of vec4, two per pixel of the band, first row of the band first:
/// (radiance rgb incl. background, bits of the samples, cut_march where the driver ended the march early) and
/// (transmittance rgb, bits of 2 * skipped + terminated).
struct ComposedShader {
  static constexpr int output_binding = 0;
  static constexpr int workgroup = 8;  // pixels in x and in y
  static constexpr std::uint32_t cut_march = 0x7f000000;
  ShaderTarget target = ShaderTarget::vulkan;
  bool fast = false;
  std::vector<FloatMode> float_modes;  // empty when fast
  std::string text;
  std::vector<std::string> sources;  // the file of `#line`'s source number
  UniformBlock band;                 // frame_band_y, frame_width, frame_height: the backend's own
  std::vector<UniformBlock> blocks;
  std::vector<PagedBuffer> buffers;
};

}  // namespace dvrlab
