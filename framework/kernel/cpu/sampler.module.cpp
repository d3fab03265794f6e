// The sampler as a kernel module: starts rays and fills chunks. Compiled once per instruction set.
// A positional sampler (DVR_KERNEL_FILE defines sample_value(p) and sample_gradient(p), p in sampler coordinates) has
// one variant per voxel type; a walking one (walk_start, walk_next, walk_gradient) has one.
#include "framework/kernel/cpu/kernel.h"

#define DVR_RGB 0  // the sampler asks the medium only where it is shaded: the same for grey and RGB
#define DVR_FULL 0

namespace {
using namespace dvr;
using dvr::floor;

#if DVR_WALKING
#include "framework/kernel/cpu/walker_variant.h"
#else
#if DVR_HAS_VOXELS
#define DVR_STRUCT Sampler_u8
#define DVR_VOXEL uint8_t
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_U8
#include "framework/kernel/cpu/sampler_variant.h"
#define DVR_STRUCT Sampler_i8
#define DVR_VOXEL int8_t
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_I8
#include "framework/kernel/cpu/sampler_variant.h"
#define DVR_STRUCT Sampler_u16
#define DVR_VOXEL uint16_t
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_U16
#include "framework/kernel/cpu/sampler_variant.h"
#define DVR_STRUCT Sampler_i16
#define DVR_VOXEL int16_t
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_I16
#include "framework/kernel/cpu/sampler_variant.h"
#endif
#define DVR_STRUCT Sampler_f32
#define DVR_VOXEL float
#define DVR_VOXEL_ELEMENT DVR_ELEMENT_F32
#include "framework/kernel/cpu/sampler_variant.h"
#endif

template <class S>
int make(void* frame, const dvr_bindings* bindings, module_calls* calls, char* missing) {
  missing[0] = 0;
  new (frame) S(bindings, missing);
  calls->sampler.start = [](const void* f, ray_packet* p) { local<S>(f).start(p); };
  calls->sampler.fill = [](const void* f, ray_packet* p, ray_chunk* c) { return local<S>(f).fill(p, c); };
  return missing[0] != 0;
}

int init(void* frame, const dvr_bindings* bindings, int, module_calls* calls, char* missing) {
#if DVR_HAS_VOXELS
  for (int k = 0; k < bindings->buffer_count; ++k) {
    if (strcmp(bindings->buffers[k].name, DVR_KERNEL_NAME "_voxels") != 0) continue;
    switch (bindings->buffers[k].element) {
      case DVR_ELEMENT_U8:
        return make<Sampler_u8>(frame, bindings, calls, missing);
      case DVR_ELEMENT_I8:
        return make<Sampler_i8>(frame, bindings, calls, missing);
      case DVR_ELEMENT_U16:
        return make<Sampler_u16>(frame, bindings, calls, missing);
      case DVR_ELEMENT_I16:
        return make<Sampler_i16>(frame, bindings, calls, missing);
      default:
        break;
    }
  }
#endif
#if DVR_WALKING
  return make<Walker>(frame, bindings, calls, missing);
#else
  return make<Sampler_f32>(frame, bindings, calls, missing);
#endif
}

#if DVR_WALKING
typedef Walker largest;
constexpr unsigned walk_bytes = sizeof(Walker::walk_state);
#else
typedef Sampler_f32 largest;
constexpr unsigned walk_bytes = 0;
#endif

const dvr_kernel_module module = {DVR_KERNEL_ABI,   "sampler",  DVR_KERNEL_NAME, W, DVR_PACKET_COLUMNS, sizeof(largest),
                                  alignof(largest), walk_bytes, DVR_INIT(&init)};
}  // namespace

extern "C" __attribute__((visibility("default"))) const dvr_kernel_module* dvrlab_kernel_module() { return &module; }
