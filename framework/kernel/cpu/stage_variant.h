// Grey or RGB variant of a stage module (not guarded).
template <class Voxel>
struct DVR_STRUCT : kernel_base {
  using kernel_base::kernel_base;
#define VOXELS(name) dvr::voxels<Voxel> name = {this->template buffer<Voxel>(#name, element_of<Voxel>)};
// The order of the texts matters.
// clang-format off
#include "framework/kernel/cpu/spectral.h"
#include "framework/kernel/cpu/math.h"
#include "framework/kernel/medium.kernel"
#include "framework/kernel/volume.kernel"
#include DVR_KERNEL_FILE
// clang-format on
#undef VOXELS

  // Lanes beyond x1 repeat the last voxel.
  KFN void fill_row(int x0, int x1, int y, int z, scalar* out) {
    alignas(64) int lanes[DVR_MAX_WIDTH];
    alignas(64) scalar values[DVR_MAX_WIDTH];
    for (int l = 0; l < W; ++l) lanes[l] = l;
    for (int x = x0; x < x1; x += W) {
      store(values, stage_voxel(imin(load(lanes) + I(x), I(x1 - 1)), I(y), I(z)));
      for (int l = 0; l < W && x + l < x1; ++l) out[x - x0 + l] = values[l];
    }
  }
};
#undef DVR_STRUCT
#undef DVR_RGB
