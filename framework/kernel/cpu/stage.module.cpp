// A light stage as a kernel module: fills a volume, row by row. DVR_KERNEL_FILE defines
//   vec4r stage_voxel(inti x, inti y, inti z)
// of which the first stage_channels numbers are kept, and names what it reads: VOLUME(...), volumes of earlier stages.
// It asks the field by sample_value(p), which is the sampler module's, and marches towards lights by light_ray.kernel.
// Compiled once per instruction set, for grey and for RGB extinction.
#include "framework/kernel/cpu/kernel.h"
#include "framework/kernel/cpu/rows.h"

namespace {
using namespace dvr;
using dvr::floor;

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
  calls->stage.fill_row = [](const void* f, int x0, int x1, int y, int z, scalar* out, unsigned long long plane) {
    local<S>(f).fill_row(x0, x1, y, z, out, plane);
  };
  return missing[0] != 0;
}

int init(void* frame, const dvr_bindings* bindings, int features, module_calls* calls, char* missing) {
  return (features & DVR_FEATURE_RGB) != 0 ? make<Stage_rgb>(frame, bindings, calls, missing)
                                           : make<Stage_grey>(frame, bindings, calls, missing);
}

constexpr unsigned larger(unsigned a, unsigned b) { return a < b ? b : a; }
const dvr_kernel_module module = {DVR_KERNEL_ABI,
                                  "stage",
                                  DVR_KERNEL_NAME,
                                  W,
                                  DVR_PACKET_COLUMNS,
                                  larger(sizeof(Stage_grey), sizeof(Stage_rgb)),
                                  larger(alignof(Stage_grey), alignof(Stage_rgb)),
                                  0,
                                  DVR_INIT(&init)};
}  // namespace

extern "C" __attribute__((visibility("default"))) const dvr_kernel_module* dvrlab_kernel_module() { return &module; }
