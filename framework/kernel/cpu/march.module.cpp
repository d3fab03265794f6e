// Ray set-up and compositing as a kernel module of the cpu backend.
#include "framework/kernel/cpu/kernel.h"

namespace {
using namespace dvr;
using dvr::floor;

#define DVR_FULL 0
#define DVR_STRUCT March_grey
#define DVR_RGB 0
#include "framework/kernel/cpu/march_variant.h"
#define DVR_STRUCT March_rgb
#define DVR_RGB 1
#include "framework/kernel/cpu/march_variant.h"

template <class M>
int make(void* frame, const dvr_bindings* bindings, module_calls* calls, char* missing) {
  missing[0] = 0;
  new (frame) M(bindings, missing);
  calls->march.begin = [](const void* f, int x, int y, ray_packet* p) { local<M>(f).begin(x, y, p); };
  calls->march.composite = [](const void* f, ray_packet* p, const ray_chunk* c) { local<M>(f).run(p, c); };
  calls->march.finish = [](const void* f, ray_packet* p) { local<M>(f).finish(p); };
  return missing[0] != 0;
}

int init(void* frame, const dvr_bindings* bindings, int features, module_calls* calls, char* missing) {
  return (features & DVR_FEATURE_RGB) != 0 ? make<March_rgb>(frame, bindings, calls, missing)
                                           : make<March_grey>(frame, bindings, calls, missing);
}

const dvr_kernel_module module = {
    DVR_KERNEL_ABI,     "march", DVR_KERNEL_NAME, W, DVR_PACKET_COLUMNS, sizeof(March_grey),
    alignof(March_rgb), 0,       DVR_INIT(&init)};
static_assert(sizeof(March_grey) == sizeof(March_rgb));
}  // namespace

extern "C" __attribute__((visibility("default"))) const dvr_kernel_module* dvrlab_kernel_module() { return &module; }
