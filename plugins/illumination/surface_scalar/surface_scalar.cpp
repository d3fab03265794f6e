// Blinn-Phong shading that fades to unshaded where the gradient is small (Kniss et al. 2002): fills the parameters of
// the framework's shading kernel.
#include "framework/interfaces/blinn_phong_keys.h"
#include "framework/interfaces/error.h"

namespace dvrlab::surface_scalar {
namespace {

using enum ParameterType;

constexpr Parameter parameters[] = {
    ambient_key,
    diffuse_key,
    specular_key,
    shininess_key,
    two_sided_key,
    {"unlit_gradient", number, "value/length", "0", "[0,inf)",
     "Gradient magnitude (physical value per world unit) up to which matter is unshaded: surface scalar 0.",
     Affects::pixels, "", "2"},
    {"lit_gradient", number, "value/length", nullptr, "(0,inf)",
     "Gradient magnitude from which matter is shaded as a surface: surface scalar 1; linear between the two.",
     Affects::pixels, "", "9"},
};

class SurfaceScalar : public IlluminationPlugin {
 public:
  void check(const ParameterSet& p) const override {
    if (p.number("unlit_gradient") >= p.number("lit_gradient"))
      throw InputError(p.path_of("lit_gradient") + ": is not above unlit_gradient; give a larger one");
  }
  void shade(const ParameterSet& p, LocalShading& s) const override {
    shade_blinn_phong(p, s);
    s.surface_scalar = {p.number("unlit_gradient"), p.number("lit_gradient")};
  }
};

}  // namespace

DVRLAB_PLUGIN(
    "illumination", "surface_scalar", "1.0", SurfaceScalar, parameters,
    "Blinn-Phong shading, faded to unshaded where the gradient is small",
    "J. Kniss, G. Kindlmann, C. Hansen, Multidimensional Transfer Functions for Interactive Volume Rendering, "
    "TVCG 8(3), 2002, doi:10.1109/TVCG.2002.1021579")

}  // namespace dvrlab::surface_scalar
