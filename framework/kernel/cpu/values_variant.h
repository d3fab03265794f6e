// A positional sampler of one voxel type that answers light stages (not guarded): no ray, and rows of voxels are read
// as rows.
struct DVR_STRUCT : kernel_base {
  using kernel_base::kernel_base;
#define VOXELS(name) dvr::voxels<DVR_VOXEL> name = {this->buffer<DVR_VOXEL>(#name, DVR_VOXEL_ELEMENT)};
// The order of the texts matters.
// clang-format off
#include "framework/kernel/cpu/spectral.h"
#include "framework/kernel/cpu/math.h"
#include "framework/kernel/volume.kernel"
#include "framework/kernel/blocks.kernel"
#include DVR_KERNEL_FILE
  // clang-format on
#undef VOXELS
  template <class T>
  KFN static cell8 fetch_cell(dvr::voxels<T> b, inti base, int dy, int dz) {
    return fetch_row_cell(b, base, dy, dz);
  }
  template <class T>
  KFN static cell8 fetch_cell(dvr::voxels<T> b, inti base, inti dy, inti dz) {
    return dvr::fetch_cell(b, base, dy, dz);
  }
  KFN void values(const scalar (*p)[DVR_MAX_WIDTH], scalar* v) { store(v, sample_value(load3(p))); }
};
#undef DVR_STRUCT
