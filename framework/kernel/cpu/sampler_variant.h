// One voxel type of the sampler module (not guarded: included once per type), and in fp64 its walk for sampling
// "cells".
struct DVR_STRUCT : kernel_base {
  using kernel_base::kernel_base;
#define VOXELS(name) dvr::voxels<DVR_VOXEL> name = {this->buffer<DVR_VOXEL>(#name, DVR_VOXEL_ELEMENT)};
// The order of the texts matters.
// clang-format off
#include "framework/kernel/cpu/spectral.h"
#include "framework/kernel/cpu/math.h"
#include "framework/kernel/medium.kernel"
#include "framework/kernel/ray.kernel"
#include "framework/kernel/random.kernel"
#include "framework/kernel/steps.kernel"
#include "framework/kernel/volume.kernel"
#include "framework/kernel/blocks.kernel"
#include "framework/kernel/light_volume.kernel"
#include DVR_KERNEL_FILE
  // clang-format on
  UNIFORM_I(frame_samples_ends)
  UNIFORM_I(frame_neighbours)
  UNIFORM_I(frame_gradient)
#undef VOXELS
#if DVR_BESIDE
  // The voxels with light beside them, where the backend has laid it there.
  const uint8_t* light_beside =
      sizeof(DVR_VOXEL) <= 2 ? this->offered<uint8_t>("frame_light_beside", DVR_ELEMENT_U8) : nullptr;
#else
  static constexpr const uint8_t* light_beside = nullptr;
#endif

#if defined(DVR_ISA_avx512) || defined(DVR_ISA_avx2)
  // Bins of the medium as 32 groups of values, a bit each, from the prefix sums over bins: whether an interval counts
  // is a shift away then, not two look-ups, and a group more is only work. SSE has no such shift.
  uint32_t shaded_groups = frame_gradient != 0 ? groups_of(medium_shaded_sum) : 0;
  uint32_t lit_groups = frame_lit != 0 ? groups_of(medium_lit_sum) : 0;
  uint32_t groups_of(tablei sum) const {
    const double last = double(medium_last), width = (last + 1) / 32, margin = 0.01;
    uint32_t groups = 0;
    for (int g = 0; g < 32; ++g) {
      const double low = g * width - margin, high = (g + 1) * width + margin;
      const int first = low > 1 ? int(low) - 1 : 0, end = int(high < last ? high : last) + 2;
      if (sum.data[end] > sum.data[first]) groups |= uint32_t(1) << g;
    }
    return groups;
  }
  KFN inti group_of(real v) { return to_int(medium_coordinate(v) * R(32.0f / (medium_last + 1.0f))); }
  KFN mask any_group(uint32_t groups, real a, real b) {
    const inti first = group_of(rmin(a, b)), last = group_of(rmax(a, b));
    const vu between = (vu(I(2).v) << vu((last - first).v)) - 1;
    return !(inti{vi((vu(I(int(groups)).v) >> vu(first.v)) & between)} == I(0));
  }
  KFN mask may_be_shaded(real a, real b) { return any_group(shaded_groups, a, b); }
  KFN mask may_be_lit(real a, real b) { return any_group(lit_groups, a, b); }
#else
  KFN mask may_be_shaded(real a, real b) { return medium_shaded(a, b); }
  KFN mask may_be_lit(real a, real b) { return medium_lit(a, b); }
#endif

  // Moves the packet's origin to the entry point and counts its segments.
  KFN void start(ray_packet* p) {
    ray r;
    r.grid_o = load3(p->grid_o);
    r.grid_d = load3(p->grid_d);
    r.world_o = load3(p->world_o);
    r.world_d = load3(p->world_d);
    const span s = clip_ray(r);
    const real L = s.t1 - s.t0;
    store3(p->grid_o, r.grid_o + r.grid_d * s.t0);
    store3(p->world_o, r.world_o + r.world_d * s.t0);
    real offset = R(0.0f);
    if (frame_jitter_on != 0) offset = jitter_offset(load(p->x), load(p->y));
    const mask hit = L > R(0.0f);
    store(p->n, select(hit, steps_count(select(hit, L, R(1.0f)), offset), I(0)));
    store(p->i, I(0));
    store(p->skipped, I(0));
    store(p->length, select(hit, L, R(0.0f)));
    store(p->offset, offset);
    p->carried = 0;
  }

  KFN inti leap(inti i, inti n, real L, real offset, vec3r o, vec3r d, ray_packet* p) {
    for (;;) {
      const inti next = steps_leap(i, n, L, offset, o, d);
      const mask moved = next > i;
      if (!any_lane(moved)) return i;
      store(p->skipped, load(p->skipped) + (next - i));
      i = next;
      p->carried = 0;
    }
  }

  KFN int fill(ray_packet* p, ray_chunk* c) {
    const inti n = load(p->n);
    inti i = load(p->i);
    const real L = load(p->length), offset = load(p->offset);
    const vec3r o = load3(p->grid_o), d = load3(p->grid_d);
    if (frame_skip != 0) i = leap(i, n, L, offset, o, d, p);
    int steps = max_lane(n - i);
    if (steps <= 0) return 0;
    steps = steps < DVR_CHUNK ? steps : DVR_CHUNK;
    // centre: row r is the centre of segment i+r-1; ends: row r is the front end of segment i+r.
    const bool ends = frame_samples_ends != 0, around = frame_neighbours != 0;
    const int first = ends || around ? 0 : 1, last = ends ? steps : around ? steps + 1 : steps;
    int row = first;
    if (p->carried && (ends || around)) {  // what the last chunk sampled already
      const int keep = ends ? 1 : 2, from = ends ? c->n : c->n;
      for (int k = 0; k < keep; ++k) {
        store(c->s + k * W, load(c->s + (from + k) * W));
        store(c->v + k * W, load(c->v + (from + k) * W));
        if (light_beside)
          for (int ch = 0; ch < 3; ++ch) store(c->m[ch] + k * W, load(c->m[ch] + (from + k) * W));
      }
      row = keep;
    }
    if (ends) {
      for (; row <= last; ++row) sample(c, row, steps_end(i + I(row), n, L, offset), o, d);
    } else {
      for (; row <= last; ++row) sample(c, row, steps_centre(i + I(row - 1), n, L, offset), o, d);
    }
    for (int k = 0; k < steps; ++k) {
      const inti j = i + I(k);
      store(c->len + k * W, select(j < n, steps_length(j, n, L, offset), R(0.0f)));
    }
    if (frame_gradient != 0) {
      if (ends) {
        gradients_at_ends(c, steps, o, d);
      } else {
        for (int k = 1; k <= steps; ++k) {
          const real v = load(c->v + k * W);
          if (any_lane(may_be_shaded(v, v) && load(c->len + (k - 1) * W) > R(0.0f))) gradient(c, k, o, d);
        }
      }
    }
    if (frame_lit != 0 && !light_beside) light(c, steps, ends, o, d);
    store(p->i, i + I(steps));
    p->carried = 1;
    c->n = steps;
    return steps;
  }

  KFN void sample(ray_chunk* c, int row, real s, vec3r o, vec3r d) {
    store(c->s + row * W, s);
#if DVR_BESIDE
    if constexpr (sizeof(DVR_VOXEL) <= 2)
      if (light_beside) return sample_with_light(c, row, o + d * s);
#endif
    store(c->v + row * W, sample_value(o + d * s));
  }
#if DVR_BESIDE
  KFN void sample_with_light(ray_chunk* c, int row, vec3r p) {
    const volume_cell k = sample_cell(p);
    const beside_cell b =
        fetch_beside_cell<DVR_VOXEL>(light_beside, k.base, frame_light_nx, frame_light_nx * frame_light_ny);
    const real v = volume_mix(b.corners<DVR_VOXEL, false>(), k.f);
    store(c->v + row * W, v);
    if (frame_samples_ends == 0 && !any_lane(may_be_lit(v, v))) return;
    const real m = volume_mix(b.corners<DVR_VOXEL, true>(), k.f) * R(frame_light_unit);
    for (int ch = 0; ch < 3; ++ch) store(c->m[ch] + row * W, m);
  }
#endif
  KFN void gradient(ray_chunk* c, int row, vec3r o, vec3r d) {
    const vec3r g = sample_gradient(o + d * load(c->s + row * W));
    store(c->g[0] + row * W, g.x);
    store(c->g[1] + row * W, g.y);
    store(c->g[2] + row * W, g.z);
  }
  KFN void light(ray_chunk* c, int row, vec3r o, vec3r d) {
    const vec3r m = sample_light(o + d * load(c->s + row * W));
    store(c->m[0] + row * W, m.x);
    store(c->m[1] + row * W, m.y);
    store(c->m[2] + row * W, m.z);
  }
  // Rows of segments that may be lit: their back ends or centres, and with `ends` their front ends.
  KFN void light(ray_chunk* c, int steps, bool ends, vec3r o, vec3r d) {
    bool done = false;  // the light of row k is there
    for (int k = 0; k < steps; ++k) {
      const real v = load(c->v + (k + 1) * W);
      const mask lit = may_be_lit(ends ? load(c->v + k * W) : v, v);
      const bool wanted = any_lane(lit && load(c->len + k * W) > R(0.0f));
      if (wanted && ends && !done) light(c, k, o, d);
      if (wanted) light(c, k + 1, o, d);
      done = wanted;
    }
  }
  KFN void gradients_at_ends(ray_chunk* c, int steps, vec3r o, vec3r d) {
    bool done = false;  // the gradient of row k is there
    for (int k = 0; k < steps; ++k) {
      const real v0 = load(c->v + k * W), v1 = load(c->v + (k + 1) * W);
      const bool wanted = any_lane(may_be_shaded(v0, v1) && load(c->len + k * W) > R(0.0f));
      if (wanted && !done) gradient(c, k, o, d);
      if (wanted) gradient(c, k + 1, o, d);
      done = wanted;
    }
  }
};
#undef DVR_STRUCT
#define DVR_STRUCT DVR_VALUES
#include "framework/kernel/cpu/values_variant.h"
#ifdef DVR_ISA_fp64
#define DVR_STRUCT DVR_CELLS
#include "framework/kernel/cpu/walker_variant.h"
#undef DVR_STRUCT
#endif
#undef DVR_CELLS
#undef DVR_VALUES
#undef DVR_VOXEL
#undef DVR_VOXEL_ELEMENT
