// Grey or RGB variant of a stage module (not guarded).
struct DVR_STRUCT : kernel_base {
  using kernel_base::kernel_base;
// The order of the texts matters.
// clang-format off
#include "framework/kernel/cpu/spectral.h"
#include "framework/kernel/cpu/math.h"
#include "framework/kernel/volume.kernel"
#include "framework/kernel/blocks.kernel"
#include "framework/kernel/random.kernel"
#include "framework/kernel/light_ray.kernel"
#include DVR_KERNEL_FILE
  // clang-format on

  const dvr_field* field = &bindings->field;

  KFN real sample_value(vec3r p) const {
    alignas(64) scalar place[3][DVR_MAX_WIDTH], value[DVR_MAX_WIDTH];
    store3(place, p);
#ifdef DVR_ISA_fp64
    field->values64(field->frame, place, value);
#else
    field->values(field->frame, place, value);
#endif
    return load(value);
  }
  template <class T>
  KFN static cell8 fetch_cell(dvr::voxels<T> b, inti base, int dy, int dz) {
    return fetch_row_cell(b, base, dy, dz);
  }
  template <class T>
  KFN static cell8 fetch_cell(dvr::voxels<T> b, inti base, inti dy, inti dz) {
    return dvr::fetch_cell(b, base, dy, dz);
  }

  // The last packet of a row begins earlier rather than being short: its lanes stand side by side then.
  KFN void fill_row(int x0, int x1, int y, int z, scalar* out, unsigned long long plane) {
    alignas(64) int lanes[DVR_MAX_WIDTH];
    alignas(64) scalar values[4][DVR_MAX_WIDTH];
    for (int l = 0; l < W; ++l) lanes[l] = l;
    for (int x = x0; x < x1; x += W) {
      const int first = x + W <= x1 || x1 - W < x0 ? x : x1 - W;
      const vec4r v = stage_voxel(imin(load(lanes) + I(first), I(x1 - 1)), I(y), I(z));
      store(values[0], v.x);
      store(values[1], v.y);
      store(values[2], v.z);
      store(values[3], v.w);
      for (int c = 0; c < stage_channels; ++c)
        for (int l = 0; l < W && first + l < x1; ++l) out[c * plane + unsigned(first + l - x0)] = values[c][l];
    }
  }
};
#undef DVR_STRUCT
#undef DVR_RGB
