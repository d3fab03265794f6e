// The walking sampler module: segments end where the kernel's walk finds the next face (not guarded). The contract of
// walk_state, walk_start, walk_next and walk_gradient stands in framework/kernel/walk.glsl. With DVR_VOXEL the walk is
// that of sampling "cells" over a positional sampler, which also shades: it knows the ray in the world.
struct DVR_STRUCT : kernel_base {
  using kernel_base::kernel_base;
#ifdef DVR_VOXEL
#define VOXELS(name) dvr::voxels<DVR_VOXEL> name = {this->buffer<DVR_VOXEL>(#name, DVR_VOXEL_ELEMENT)};
#endif
// The order of the texts matters.
// clang-format off
#include "framework/kernel/cpu/spectral.h"
#include "framework/kernel/cpu/math.h"
#include "framework/kernel/medium.kernel"
#include "framework/kernel/ray.kernel"
#include "framework/kernel/parts.kernel"
#include "framework/kernel/volume.kernel"
#include "framework/kernel/blocks.kernel"
#include "framework/kernel/light_volume.kernel"
  UNIFORM_I(frame_samples_ends)
  UNIFORM_I(frame_gradient)
#ifdef DVR_VOXEL
  vec3r walk_world_o, walk_world_d;
  real walk_inv_L;
#include "framework/kernel/shading.kernel"
#include DVR_KERNEL_FILE
#include "framework/kernel/cells.kernel"
#undef VOXELS
#else
#if DVR_TETRAHEDRA
#include "framework/kernel/entry.kernel"
#include "framework/kernel/cpu/entry.h"
#include "framework/kernel/tetrahedra.kernel"
#undef ENTRY
#undef entry_next
#endif
#include DVR_KERNEL_FILE
#endif
  // clang-format on

  KFN void see(const ray_packet* p) {
#ifdef DVR_VOXEL
    walk_world_o = load3(p->world_o);
    walk_world_d = load3(p->world_d);
    walk_inv_L = rcp(rmax(load(p->length), R(1e-30)));
#endif
  }

  KFN void start(ray_packet* p) {
    ray r;
    r.grid_o = load3(p->grid_o);
    r.grid_d = load3(p->grid_d);
    r.world_o = load3(p->world_o);
    r.world_d = load3(p->world_d);
    const span s = clip_ray(r);
    const real L = s.t1 - s.t0;
    const mask hit = L > R(0.0f);
    const vec3r o = r.grid_o + r.grid_d * s.t0;
    dvr::store3(p->grid_o, o);
    dvr::store3(p->world_o, r.world_o + r.world_d * s.t0);
    store(p->n, select(hit, I(DVR_WALK_OPEN), I(0)));
    store(p->i, I(0));
    store(p->skipped, I(0));
    store(p->length, select(hit, L, R(0.0f)));
    store(p->offset, R(0.0f));
    see(p);
    walk_memory* m = static_cast<walk_memory*>(p->walk);
    walk_start(o, r.grid_d, select(hit, L, R(0.0f)), m->back);
    m->front = m->back;
    m->part = I(0);
    m->parts = I(0);
  }

  // What a packet keeps between chunks: the segment that is being passed, and how many of its parts are.
  struct walk_memory {
    walk_state back;
    walk_state front;
    inti part;
    inti parts;
  };

  // `ends`: row k is the front end of segment k, row k+1 its back end, as the positional sampler leaves them.
  // `centre`: row k+1 is the centre of segment k, half way, since the scalar is linear between faces.
  KFN int fill(ray_packet* p, ray_chunk* c) { return frame_parts != 0 ? fill_parts(p, c) : fill_whole(p, c); }

  KFN int fill_whole(ray_packet* p, ray_chunk* c) {
    const inti i = load(p->i);
    inti n = load(p->n);
    if (!any_lane(i < n)) return 0;
    const real L = load(p->length);
    const vec3r o = load3(p->grid_o), d = load3(p->grid_d);
    see(p);
    walk_state w = static_cast<walk_memory*>(p->walk)->back;
    int k = 0;
    for (; k < DVR_CHUNK && any_lane(i + I(k) < n); ++k) {
      const mask alive = i + I(k) < n;
      const walk_state front = w;
      const inti kind = walk_next(o, d, L, w);
      n = select(alive && kind == I(0), i + I(k), n);
      put(c, k, alive && kind == I(1), o, d, front, front.s, front.v, w.s, w.v);
    }
    static_cast<walk_memory*>(p->walk)->back = w;
    store(p->n, n);
    store(p->i, i + I(k));
    c->n = k;
    return k;
  }

  KFN int fill_parts(ray_packet* p, ray_chunk* c) {
    const inti i = load(p->i);
    inti n = load(p->n);
    if (!any_lane(i < n)) return 0;
    const real L = load(p->length);
    const vec3r o = load3(p->grid_o), d = load3(p->grid_d);
    see(p);
    walk_memory m = *static_cast<walk_memory*>(p->walk);
    int k = 0;
    for (; k < DVR_CHUNK && any_lane(i + I(k) < n); ++k) {
      const mask alive = i + I(k) < n;
      // A lane that is through with its segment goes on to the next one; the others wait for it.
      const mask next = alive && m.part >= m.parts;
      mask matter = alive && !next;
      if (any_lane(next)) {
        walk_state back = m.back;
        const inti kind = walk_next(o, d, L, back);
        n = select(next && kind == I(0), i + I(k), n);
        m.front = keep(next, m.back, m.front);
        m.back = keep(next, back, m.back);
        m.part = select(next, I(0), m.part);
        m.parts = select(next, select(kind == I(1), parts_of(m.back.s - m.front.s), I(0)), m.parts);
        matter = matter || (next && kind == I(1));
      }
      const real s0 = parts_end(m.front.s, m.back.s, m.part, m.parts),
                 s1 = parts_end(m.front.s, m.back.s, m.part + I(1), m.parts);
      const real v0 = parts_end(m.front.v, m.back.v, m.part, m.parts),
                 v1 = parts_end(m.front.v, m.back.v, m.part + I(1), m.parts);
      put(c, k, matter, o, d, m.front, s0, v0, s1, v1);
      m.part = select(matter, m.part + I(1), m.part);
    }
    *static_cast<walk_memory*>(p->walk) = m;
    store(p->n, n);
    store(p->i, i + I(k));
    c->n = k;
    return k;
  }
  // Whole states: numbers and nothing else.
  KFN static walk_state keep(mask on, const walk_state& a, const walk_state& b) {
    walk_state r;
    static_assert(sizeof(walk_state) % sizeof(real) == 0 && sizeof(real) % sizeof(vi) == 0);
    constexpr int words = int(sizeof(walk_state) / sizeof(inti));
    inti x[words], y[words];
    memcpy(x, &a, sizeof(walk_state));
    memcpy(y, &b, sizeof(walk_state));
    for (int j = 0; j < words; ++j) x[j] = select(on, x[j], y[j]);
    memcpy(&r, x, sizeof(walk_state));
    return r;
  }

  // Row k: a segment of matter where `on`.
  KFN void put(ray_chunk* c, int k, mask on, vec3r o, vec3r d, const walk_state& front, real s0, real v0, real s1,
               real v1) {
    store(c->len + k * W, select(on, s1 - s0, R(0.0f)));
    const bool ends = frame_samples_ends != 0;
    if (ends) {
      put(c, k, s0, v0);
      put(c, k + 1, s1, v1);
    } else {
      put(c, k + 1, R(0.5f) * (s0 + s1), R(0.5f) * (v0 + v1));
    }
    if (frame_gradient != 0 && any_lane(on && medium_shaded(v0, v1))) {
      const vec3r a = walk_gradient(o, d, front, s0), b = walk_gradient(o, d, front, s1);
      store3(c->h, k, a);
      store3(c->g, k + 1, ends ? b : (a + b) * R(0.5f));
    }
    if (frame_lit != 0 && any_lane(on && medium_lit(v0, v1))) {
      const vec3r b = sample_light(o + d * (ends ? s1 : R(0.5f) * (s0 + s1)));
      store3(c->m, k, ends ? sample_light(o + d * s0) : b);
      store3(c->m, k + 1, b);
    }
  }

  KFN static void put(ray_chunk* c, int row, real s, real v) {
    store(c->s + row * W, s);
    store(c->v + row * W, v);
  }
  template <class Rows>
  KFN static void store3(Rows& rows, int row, vec3r g) {
    store(rows[0] + row * W, g.x);
    store(rows[1] + row * W, g.y);
    store(rows[2] + row * W, g.z);
  }
};
