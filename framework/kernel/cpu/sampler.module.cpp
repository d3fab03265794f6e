// The sampler as a kernel module: starts rays and fills chunks. Compiled once per instruction set.
// A positional sampler (DVR_KERNEL_FILE defines sample_value(p) and sample_gradient(p), p in sampler coordinates) has
// one variant per voxel type; a walking one (walk_start, walk_next, walk_gradient) has one.
#include "framework/kernel/cpu/beside.h"
#include "framework/kernel/cpu/kernel.h"
#include "framework/kernel/cpu/rows.h"

#define DVR_RGB 0  // the sampler asks the medium only where it is shaded: the same for grey and RGB
#define DVR_FULL 0

#if DVR_HAS_CELLS && !defined(DVR_SCALAR)
#define DVR_BESIDE 1  // light may lie beside the voxels
#else
#define DVR_BESIDE 0
#endif

namespace {
using namespace dvr;
using dvr::floor;

#if DVR_WALKING
#define DVR_STRUCT Walker
#include "framework/kernel/cpu/walker_variant.h"
#else
#if DVR_HAS_VOXELS
#define DVR_STRUCT Sampler_u8
#define DVR_CELLS Cells_u8
#define DVR_VALUES Values_u8
#define DVR_VOXEL uint8_t
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_U8
#include "framework/kernel/cpu/sampler_variant.h"
#define DVR_STRUCT Sampler_i8
#define DVR_CELLS Cells_i8
#define DVR_VALUES Values_i8
#define DVR_VOXEL int8_t
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_I8
#include "framework/kernel/cpu/sampler_variant.h"
#define DVR_STRUCT Sampler_u16
#define DVR_CELLS Cells_u16
#define DVR_VALUES Values_u16
#define DVR_VOXEL uint16_t
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_U16
#include "framework/kernel/cpu/sampler_variant.h"
#define DVR_STRUCT Sampler_i16
#define DVR_CELLS Cells_i16
#define DVR_VALUES Values_i16
#define DVR_VOXEL int16_t
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_I16
#include "framework/kernel/cpu/sampler_variant.h"
#endif
#define DVR_STRUCT Sampler_f32
#define DVR_CELLS Cells_f32
#define DVR_VALUES Values_f32
#define DVR_VOXEL float
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_F32
#include "framework/kernel/cpu/sampler_variant.h"
#endif

template <class S>
int make(void* frame, const dvr_bindings* bindings, module_calls* calls, char* missing) {
  missing[0] = 0;
  new (frame) S(bindings, missing);
  calls->sampler.values = nullptr;
  calls->sampler.start = [](const void* f, ray_packet* p) { local<S>(f).start(p); };
  calls->sampler.fill = [](const void* f, ray_packet* p, ray_chunk* c) { return local<S>(f).fill(p, c); };
  return missing[0] != 0;
}

#if !DVR_WALKING
template <class S>
int make_values(void* frame, const dvr_bindings* bindings, module_calls* calls, char* missing) {
  missing[0] = 0;
  new (frame) S(bindings, missing);
  calls->sampler = {};
  calls->sampler.values = [](const void* f, const scalar(*p)[DVR_MAX_WIDTH], scalar* v) { local<S>(f).values(p, v); };
  return missing[0] != 0;
}
#endif

// Sampling "cells" walks (fp64 only): the frame says so by the uniform frame_cells.
#if defined(DVR_ISA_fp64) && !DVR_WALKING
bool cells(const dvr_bindings* bindings) {
  for (int k = 0; k < bindings->uniform_count; ++k)
    if (strcmp(bindings->uniforms[k].name, "frame_cells") == 0) return true;
  return false;
}
#define DVR_MAKE(type)                                                                                \
  ((features & DVR_FEATURE_VALUES) != 0 ? make_values<Values_##type>(frame, bindings, calls, missing) \
   : cells(bindings)                    ? make<Cells_##type>(frame, bindings, calls, missing)         \
                                        : make<Sampler_##type>(frame, bindings, calls, missing))
#else
#define DVR_MAKE(type)                                                                                \
  ((features & DVR_FEATURE_VALUES) != 0 ? make_values<Values_##type>(frame, bindings, calls, missing) \
                                        : make<Sampler_##type>(frame, bindings, calls, missing))
#endif

int init(void* frame, const dvr_bindings* bindings, int features, module_calls* calls, char* missing) {
#if DVR_HAS_VOXELS
  for (int k = 0; k < bindings->buffer_count; ++k) {
    if (strcmp(bindings->buffers[k].name, DVR_KERNEL_NAME "_voxels") != 0) continue;
    switch (bindings->buffers[k].element) {
      case DVR_ELEMENT_U8:
        return DVR_MAKE(u8);
      case DVR_ELEMENT_I8:
        return DVR_MAKE(i8);
      case DVR_ELEMENT_U16:
        return DVR_MAKE(u16);
      case DVR_ELEMENT_I16:
        return DVR_MAKE(i16);
      default:
        break;
    }
  }
#endif
#if DVR_WALKING
  (void)features;
  return make<Walker>(frame, bindings, calls, missing);
#else
  return DVR_MAKE(f32);
#endif
}

#if DVR_WALKING
typedef Walker largest;
constexpr unsigned walk_bytes = sizeof(Walker::walk_memory);
#elif defined(DVR_ISA_fp64)
typedef Cells_f32 largest;
constexpr unsigned walk_bytes = sizeof(Cells_f32::walk_memory);
static_assert(sizeof(Cells_f32) >= sizeof(Sampler_f32) && alignof(Cells_f32) >= alignof(Sampler_f32));
#else
typedef Sampler_f32 largest;
constexpr unsigned walk_bytes = 0;
#endif

const dvr_kernel_module module = {DVR_KERNEL_ABI,   "sampler",  DVR_KERNEL_NAME, W, DVR_PACKET_COLUMNS, sizeof(largest),
                                  alignof(largest), walk_bytes, DVR_INIT(&init)};
}  // namespace

extern "C" __attribute__((visibility("default"))) const dvr_kernel_module* dvrlab_kernel_module() { return &module; }
