// The kernel language's functions over arrays, compiled exactly like kernel modules.
#include "tests/kernel/probe.h"

#include "framework/kernel/cpu/beside.h"
#include "framework/kernel/cpu/kernel.h"

namespace {
using namespace dvr;
using dvr::floor;

// The uniforms that the probed functions read. The included texts declare more: those stay 0 and are not used.
const dvr_uniform uniforms[] = {{"frame_step", DVR_F32, {1.0f, 0, 0, 0}, 0},
                                {"frame_jitter", DVR_F32, {1.0f, 0, 0, 0}, 0},
                                {"frame_seed", DVR_I32, {0, 0, 0, 0}, 7}};
const dvr_bindings bindings = {uniforms, 3, nullptr, 0, nullptr, 0, {}};

#define DVR_RGB 0
struct Probe : kernel_base {
  using kernel_base::kernel_base;
// The order of the texts matters.
// clang-format off
#include "framework/kernel/cpu/spectral.h"
#include "framework/kernel/cpu/math.h"
#include "framework/kernel/ray.kernel"
#include "framework/kernel/random.kernel"
#include "framework/kernel/steps.kernel"
  // clang-format on
};

template <class F>
void each(long n, F f) {
  char missing[128] = "";
  Probe p(&bindings, missing);
  for (long k = 0; k < n; k += W) f(p, k);
}
#define PROBE_MAP(expression)            \
  [](const float* x, float* y, long n) { \
    each(n, [=](Probe& p, long k) {      \
      const real a = load(x + k);        \
      (void)p;                           \
      store(y + k, expression);          \
    });                                  \
  }

void power(const float* x, int exponent, float* y, long n) {
  each(n, [=](Probe& p, long k) { store(y + k, p.power(load(x + k), exponent)); });
}
void pcg(const int* x, int* y, long n) {
  each(n, [=](Probe& p, long k) { store(y + k, p.pcg(load(x + k))); });
}
void jitter(const int* x, const int* y, float* offset, long n) {
  each(n, [=](Probe& p, long k) { store(offset + k, p.jitter_offset(load(x + k), load(y + k))); });
}

/// Calls f with the typed voxels.
template <class F>
void typed(int element, const void* data, F f) {
  switch (element) {
    case DVR_ELEMENT_U8:
      return f(voxels<uint8_t>{static_cast<const uint8_t*>(data)});
    case DVR_ELEMENT_I8:
      return f(voxels<int8_t>{static_cast<const int8_t*>(data)});
    case DVR_ELEMENT_U16:
      return f(voxels<uint16_t>{static_cast<const uint16_t*>(data)});
    case DVR_ELEMENT_I16:
      return f(voxels<int16_t>{static_cast<const int16_t*>(data)});
    default:
      return f(voxels<float>{static_cast<const float*>(data)});
  }
}
void fetch1_all(int element, const void* data, const int* i, float* out, long n) {
  typed(element, data, [=](auto v) {
    for (long k = 0; k < n; k += W) store(out + k, fetch1(v, load(i + k)));
  });
}
void fetch2_all(int element, const void* data, const int* i, float* out, long n) {
  typed(element, data, [=](auto v) {
    for (long k = 0; k < n; k += W) {
      real a, b;
      fetch2(v, load(i + k), a, b);
      store(out + k, a);
      store(out + n + k, b);
    }
  });
}
void store_cell(float* out, long n, const cell8& c) {
  const real corner[8] = {c.v000, c.v100, c.v010, c.v110, c.v001, c.v101, c.v011, c.v111};
  for (int j = 0; j < 8; ++j) store(out + j * n, corner[j]);
}
void fetch_cell_all(int element, const void* data, const int* base, int dy, int dz, float* out, long n) {
  typed(element, data, [=](auto v) {
    for (long k = 0; k < n; k += W) store_cell(out + k, n, fetch_cell(v, load(base + k), dy, dz));
  });
}
#ifdef DVR_SCALAR
constexpr auto fetch_beside_all = nullptr;
#else
template <class T>
void fetch_beside_of(voxels<T>, const uint8_t* data, const int* base, int dy, int dz, float* out, long n) {
  for (long k = 0; k < n; k += W) {
    const beside_cell c = fetch_beside_cell<T>(data, load(base + k), dy, dz);
    store_cell(out + k, n, c.corners<T, false>());
    store_cell(out + 8 * n + k, n, c.corners<T, true>());
  }
}
void fetch_beside_of(voxels<float>, const uint8_t*, const int*, int, int, float*, long) {
}  // no floats have levels beside
void fetch_beside_all(int element, const void* data, const int* base, int dy, int dz, float* out, long n) {
  typed(element, nullptr, [=](auto v) { fetch_beside_of(v, static_cast<const uint8_t*>(data), base, dy, dz, out, n); });
}
#endif
void store4(float* out, long n, vec4r a) {
  store(out, a.x);
  store(out + n, a.y);
  store(out + 2 * n, a.z);
  store(out + 3 * n, a.w);
}
void fetch4_all(const float* t, const int* i, float* out, long n) {
  for (long k = 0; k < n; k += W) store4(out + k, n, fetch4(table4{t}, load(i + k)));
}
void fetch4u_all(const float* t, int i, float* out, long n) {
  for (long k = 0; k < n; k += W) store4(out + k, n, fetch4u(table4{t}, i));
}
void fetch4_affine_all(const float* t, const int* i, const float* w, float* out, long n) {
  for (long k = 0; k < n; k += W) store4(out + k, n, fetch4_affine(table4{t}, load(i + k), load(w + k)));
}
void fetchi_all(const int* t, const int* i, int* out, long n) {
  for (long k = 0; k < n; k += W) store(out + k, fetchi(tablei{t}, load(i + k)));
}
void fetchi8_all(const unsigned char* t, const int* i, int* out, long n) {
  for (long k = 0; k < n; k += W) store(out + k, fetchi(bytes8{t}, load(i + k)));
}

const kernel_probe probe = {W,
                            PROBE_MAP(p.rcp(a)),
                            PROBE_MAP(p.rsqrt(a)),
                            PROBE_MAP(p.sqrt(a)),
                            PROBE_MAP(p.exp(a)),
                            PROBE_MAP(p.attenuate1(a).t),
                            PROBE_MAP(p.phi1(a)),
                            PROBE_MAP(p.sin2pi(a)),
                            PROBE_MAP(p.cos2pi(a)),
                            PROBE_MAP(floor(a)),
                            &power,
                            &pcg,
                            &jitter,
                            &fetch1_all,
                            &fetch2_all,
                            &fetch_cell_all,
                            fetch_beside_all,
                            &fetch4_all,
                            &fetch4u_all,
                            &fetch4_affine_all,
                            &fetchi_all,
                            &fetchi8_all};
}  // namespace

extern "C" __attribute__((visibility("default"))) const kernel_probe* dvrlab_kernel_probe() { return &probe; }
