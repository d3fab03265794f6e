// Light factors given as numbers: m, k, b at the two ends of every ray, linear in arc length between. For tests
// against formulas that prescribe the light.
#include <algorithm>

#include "framework/interfaces/illumination.h"

namespace {
using namespace dvrlab;
using enum ParameterType;

// m acts on the unshaded source P only: its liveness is shown with an unshaded model.
#define UNSHADED R"({"optical_model":{"shaded":false}})"
#define END_PARAMETER(name, value, what, live_in) \
  { name, vector3, "", value, "[0,inf)", what, Affects::pixels, live_in, "[0.3,0.6,0.9]" }
const Parameter parameters[] = {
    END_PARAMETER("m0", "[1,1,1]", "m (factor of P) where the ray enters.", UNSHADED),
    END_PARAMETER("m1", "[1,1,1]", "m where the ray leaves.", UNSHADED),
    END_PARAMETER("k0", "[1,1,1]", "k (factor of S) where the ray enters.", ""),
    END_PARAMETER("k1", "[1,1,1]", "k where the ray leaves.", ""),
    END_PARAMETER("b0", "[0,0,0]", "b (factor of W) where the ray enters.", ""),
    END_PARAMETER("b1", "[0,0,0]", "b where the ray leaves.", ""),
};
#undef END_PARAMETER
#undef UNSHADED

class Prescribed : public IlluminationPlugin {
 public:
  void shade(const ParameterSet& p, LocalShading& s) const override {
    s.mode = LocalShading::Mode::prescribed;
    s.m = {p.vector3("m0"), p.vector3("m1")};
    s.k = {p.vector3("k0"), p.vector3("k1")};
    s.b = {p.vector3("b0"), p.vector3("b1")};
  }
};

}  // namespace

DVRLAB_PLUGIN("illumination", "prescribed", "1.0", Prescribed, parameters,
              "light factors m, k, b given at both ends of the ray, linear between: for tests against formulas", "")
