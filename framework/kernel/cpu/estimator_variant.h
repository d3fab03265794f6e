// One variant of the estimator module (not guarded).
struct DVR_STRUCT : kernel_base {
  using kernel_base::kernel_base;
// The order of the texts matters.
// clang-format off
#include "framework/kernel/cpu/spectral.h"
#include "framework/kernel/cpu/math.h"
#include "framework/kernel/medium.kernel"
#include "framework/kernel/shading.kernel"
  UNIFORM_I(frame_lit)
#include "framework/kernel/segment.kernel"
#include "framework/kernel/mean.kernel"
#include "framework/kernel/discrete.kernel"
#include "framework/kernel/light.kernel"
#include DVR_KERNEL_FILE
#include "framework/kernel/integrate.kernel"
  // clang-format on

  UNIFORM_I(frame_samples_ends)
  UNIFORM_I(frame_walks)  // 1: a walking sampler: the gradient at the front end is its own

  // Fields of the segment that the kernel does not read are never loaded: everything is inlined into this loop.
  KFN void integrate(const ray_packet* p, ray_chunk* c) {
    segment q = segment_of_ray({load(p->world_o[0]), load(p->world_o[1]), load(p->world_o[2])},
                               {load(p->world_d[0]), load(p->world_d[1]), load(p->world_d[2])}, load(p->length));
    const int n = c->n;
    for (int k = 0; k < n; ++k) {
      const int a = k * W, b = a + W, e = b + W;
      q.len = load(c->len + a);
      q.s0 = q.s_prev = load(c->s + a);
      q.s1 = q.s = load(c->s + b);
      q.s_next = load(c->s + e);
      q.v0 = q.v_prev = load(c->v + a);
      q.v1 = q.v = load(c->v + b);
      q.v_next = load(c->v + e);
      q.g0 = frame_walks != 0 ? vec3r{load(c->h[0] + a), load(c->h[1] + a), load(c->h[2] + a)}
                              : vec3r{load(c->g[0] + a), load(c->g[1] + a), load(c->g[2] + a)};
      q.g1 = q.g = {load(c->g[0] + b), load(c->g[1] + b), load(c->g[2] + b)};
      if (frame_lit != 0) {
        const vec3r m1 = {load(c->m[0] + b), load(c->m[1] + b), load(c->m[2] + b)};
#if DVR_FULL
        q = segment_in_light(
            q, frame_samples_ends != 0 ? vec3r{load(c->m[0] + a), load(c->m[1] + a), load(c->m[2] + a)} : m1, m1);
#else
        q.m0 = m1;
#endif
      }
      vec3r color;
      spectral t;
      segment_integrate(q, color, t);
      store(c->c[0] + a, color.x);
      store(c->c[1] + a, color.y);
      store(c->c[2] + a, color.z);
#if DVR_RGB
      store(c->t[0] + a, t.x);
      store(c->t[1] + a, t.y);
      store(c->t[2] + a, t.z);
#else
      store(c->t[0] + a, t);
#endif
    }
  }
};
#undef DVR_STRUCT
#undef DVR_RGB
#undef DVR_FULL
