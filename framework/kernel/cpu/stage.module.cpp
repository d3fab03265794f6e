// A light stage as a kernel module: fills one fp32 volume, row by row. DVR_KERNEL_FILE defines
//   real stage_voxel(inti x, inti y, inti z)
// and names what it reads: VOXELS(<name>_field), the data in their own type; VOLUME(...), fp32 volumes of earlier
// stages. It sees the full medium. Compiled once per instruction set; one variant per voxel type and {grey, RGB}.
#include "framework/kernel/cpu/kernel.h"

#define DVR_FULL 1

namespace {
using namespace dvr;
using dvr::floor;

template <class T>
constexpr int element_of = DVR_ELEMENT_F32;
template <>
constexpr int element_of<uint8_t> = DVR_ELEMENT_U8;
template <>
constexpr int element_of<int8_t> = DVR_ELEMENT_I8;
template <>
constexpr int element_of<uint16_t> = DVR_ELEMENT_U16;
template <>
constexpr int element_of<int16_t> = DVR_ELEMENT_I16;

#define DVR_STRUCT Stage_grey
#define DVR_RGB 0
#include "framework/kernel/cpu/stage_variant.h"
#define DVR_STRUCT Stage_rgb
#define DVR_RGB 1
#include "framework/kernel/cpu/stage_variant.h"

template <class S>
int make(void* frame, const dvr_bindings* bindings, module_calls* calls, char* missing) {
  missing[0] = 0;
  new (frame) S(bindings, missing);
  calls->stage.fill_row = [](const void* f, int x0, int x1, int y, int z, scalar* out) {
    local<S>(f).fill_row(x0, x1, y, z, out);
  };
  return missing[0] != 0;
}
template <class T>
int make_typed(void* frame, const dvr_bindings* bindings, int features, module_calls* calls, char* missing) {
  return (features & DVR_FEATURE_RGB) != 0 ? make<Stage_rgb<T>>(frame, bindings, calls, missing)
                                           : make<Stage_grey<T>>(frame, bindings, calls, missing);
}

int init(void* frame, const dvr_bindings* bindings, int features, module_calls* calls, char* missing) {
#if DVR_HAS_VOXELS
  for (int k = 0; k < bindings->buffer_count; ++k) {
    if (strcmp(bindings->buffers[k].name, DVR_KERNEL_NAME "_field") != 0) continue;
    switch (bindings->buffers[k].element) {
      case DVR_ELEMENT_U8:
        return make_typed<uint8_t>(frame, bindings, features, calls, missing);
      case DVR_ELEMENT_I8:
        return make_typed<int8_t>(frame, bindings, features, calls, missing);
      case DVR_ELEMENT_U16:
        return make_typed<uint16_t>(frame, bindings, features, calls, missing);
      case DVR_ELEMENT_I16:
        return make_typed<int16_t>(frame, bindings, features, calls, missing);
      default:
        break;
    }
  }
#endif
  return make_typed<float>(frame, bindings, features, calls, missing);
}

const dvr_kernel_module module = {DVR_KERNEL_ABI,
                                  "stage",
                                  DVR_KERNEL_NAME,
                                  W,
                                  DVR_PACKET_COLUMNS,
                                  sizeof(Stage_rgb<float>),
                                  alignof(Stage_rgb<float>),
                                  0,
                                  DVR_INIT(&init)};
static_assert(sizeof(Stage_grey<float>) == sizeof(Stage_rgb<float>));
}  // namespace

extern "C" __attribute__((visibility("default"))) const dvr_kernel_module* dvrlab_kernel_module() { return &module; }
