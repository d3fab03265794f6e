// The estimator as a kernel module: integrates every segment of a chunk. Compiled once per instruction set; one
// variant per combination of {grey, RGB} extinction and {plain, full} medium.
#include "framework/kernel/cpu/kernel.h"

namespace {
using namespace dvr;
using dvr::floor;

#define DVR_STRUCT Estimator_grey
#define DVR_RGB 0
#define DVR_FULL 0
#include "framework/kernel/cpu/estimator_variant.h"
#define DVR_STRUCT Estimator_rgb
#define DVR_RGB 1
#define DVR_FULL 0
#include "framework/kernel/cpu/estimator_variant.h"
#define DVR_STRUCT Estimator_full_grey
#define DVR_RGB 0
#define DVR_FULL 1
#include "framework/kernel/cpu/estimator_variant.h"
#define DVR_STRUCT Estimator_full_rgb
#define DVR_RGB 1
#define DVR_FULL 1
#include "framework/kernel/cpu/estimator_variant.h"

template <class E>
int make(void* frame, const dvr_bindings* bindings, module_calls* calls, char* missing) {
  missing[0] = 0;
  new (frame) E(bindings, missing);
  calls->estimator.integrate = [](const void* f, const ray_packet* p, ray_chunk* c) { local<E>(f).integrate(p, c); };
  return missing[0] != 0;
}

int init(void* frame, const dvr_bindings* bindings, int features, module_calls* calls, char* missing) {
  switch (features & (DVR_FEATURE_RGB | DVR_FEATURE_FULL)) {
    case 0:
      return make<Estimator_grey>(frame, bindings, calls, missing);
    case DVR_FEATURE_RGB:
      return make<Estimator_rgb>(frame, bindings, calls, missing);
    case DVR_FEATURE_FULL:
      return make<Estimator_full_grey>(frame, bindings, calls, missing);
    default:
      return make<Estimator_full_rgb>(frame, bindings, calls, missing);
  }
}

constexpr unsigned larger(unsigned a, unsigned b) { return a < b ? b : a; }
const dvr_kernel_module module = {DVR_KERNEL_ABI,
                                  "estimator",
                                  DVR_KERNEL_NAME,
                                  W,
                                  DVR_PACKET_COLUMNS,
                                  larger(larger(sizeof(Estimator_grey), sizeof(Estimator_rgb)),
                                         larger(sizeof(Estimator_full_grey), sizeof(Estimator_full_rgb))),
                                  alignof(Estimator_full_rgb),
                                  0,
                                  DVR_INIT(&init)};
}  // namespace

extern "C" __attribute__((visibility("default"))) const dvr_kernel_module* dvrlab_kernel_module() { return &module; }
