// Grey or RGB variant of the march module (not guarded).
struct DVR_STRUCT : kernel_base {
  using kernel_base::kernel_base;
// The order of the texts matters.
// clang-format off
#include "framework/kernel/cpu/spectral.h"
#include "framework/kernel/cpu/math.h"
#include "framework/kernel/medium.kernel"
#include "framework/kernel/ray.kernel"
#include "framework/kernel/composite.kernel"
  // clang-format on

  KFN static spectral load_trans(const scalar* a, const scalar* b, const scalar* c) {
#if DVR_RGB
    return {load(a), load(b), load(c)};
#else
    (void)b;
    (void)c;
    return load(a);
#endif
  }
  KFN static void store_trans(ray_packet* p, spectral t) {
#if DVR_RGB
    store3(p->trans, t);
#else
    store(p->trans[0], t);
#endif
  }

  // Rays of the packet whose first pixel is (x, y).
  KFN void begin(int x, int y, ray_packet* p) {
    alignas(64) int px[DVR_MAX_WIDTH], py[DVR_MAX_WIDTH];
    for (int l = 0; l < W; ++l) {
      px[l] = x + l % DVR_PACKET_COLUMNS;
      py[l] = y + l / DVR_PACKET_COLUMNS;
    }
    store(p->x, load(px));
    store(p->y, load(py));
    const ray r = frame_ray(to_real(load(px)), to_real(load(py)));
    store3(p->grid_o, r.grid_o);
    store3(p->grid_d, r.grid_d);
    store3(p->world_o, r.world_o);
    store3(p->world_d, r.world_d);
    const real zero = R(0.0f), one = R(1.0f);
    store3(p->color, {zero, zero, zero});
    store3(p->trans, {one, one, one});
    store(p->samples, I(0));
    store(p->terminated, I(0));
  }

  // Consumes a chunk in order. A lane without a segment, or whose ray has ended, is left as it is.
  KFN void run(ray_packet* p, const ray_chunk* c) {
    vec3r color = load3(p->color);
    spectral trans = load_trans(p->trans[0], p->trans[1], p->trans[2]);
    inti samples = load(p->samples), ended = load(p->terminated);
    for (int k = 0; k < c->n; ++k) {
      const int a = k * W;
      const mask on = load(c->len + a) > R(0.0f) && ended == I(0);
      vec3r new_color = color;
      spectral new_trans = trans;
      composite({load(c->c[0] + a), load(c->c[1] + a), load(c->c[2] + a)},
                load_trans(c->t[0] + a, c->t[1] + a, c->t[2] + a), new_color, new_trans);
      color = select(on, new_color, color);
      trans = select(on, new_trans, trans);
      samples = select(on, samples + I(1), samples);
      ended = select(on && ends_ray(trans), I(1), ended);
    }
    store3(p->color, color);
    store_trans(p, trans);
    store(p->samples, samples);
    store(p->terminated, ended);
    // A ray that has ended has no segments left.
    store(p->n, select(ended == I(1), imin(load(p->n), load(p->i)), load(p->n)));
  }

  KFN void finish(ray_packet* p) {
    const spectral trans = load_trans(p->trans[0], p->trans[1], p->trans[2]);
    store3(p->color, over_background(load3(p->color), trans));
    store3(p->trans, rgb_of(trans));
  }
};
#undef DVR_STRUCT
#undef DVR_RGB
