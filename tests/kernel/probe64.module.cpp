// The elementary functions of precision fp64 over arrays, compiled exactly like kernel modules.
#include "tests/kernel/probe64.h"

#include "framework/kernel/cpu/kernel.h"

namespace {
using namespace dvr;
using dvr::floor;

#define DVR_RGB 0
struct Probe {
// The order of the texts matters.
// clang-format off
#include "framework/kernel/cpu/spectral.h"
#include "framework/kernel/cpu/math.h"
  // clang-format on
};

#define PROBE_MAP(expression)              \
  [](const double* x, double* y, long n) { \
    Probe p;                               \
    for (long k = 0; k < n; ++k) {         \
      const real a = load(x + k);          \
      (void)p;                             \
      store(y + k, expression);            \
    }                                      \
  }

const kernel_probe64 probe = {PROBE_MAP(p.rcp(a)),    PROBE_MAP(p.rsqrt(a)),        PROBE_MAP(p.sqrt(a)),
                              PROBE_MAP(p.exp(a)),    PROBE_MAP(p.attenuate1(a).t), PROBE_MAP(p.phi1(a)),
                              PROBE_MAP(p.sin2pi(a)), PROBE_MAP(p.cos2pi(a)),       PROBE_MAP(floor(a)),
                              PROBE_MAP(rabs(a)),     PROBE_MAP(p.power(a, 20))};
}  // namespace

extern "C" __attribute__((visibility("default"))) const kernel_probe64* dvrlab_kernel_probe() { return &probe; }
