// Local Blinn-Phong shading with up to four lights: fills the parameters of the framework's shading kernel.
#include "framework/interfaces/blinn_phong_keys.h"

namespace {
using namespace dvrlab;

constexpr Parameter parameters[] = {ambient_key,   diffuse_key,   specular_key,
                                    shininess_key, two_sided_key, gradient_eps_key};

class BlinnPhong : public IlluminationPlugin {
 public:
  void shade(const ParameterSet& p, LocalShading& s) const override {
    shade_blinn_phong(p, s);
    s.gradient_eps = p.number("gradient_eps");
  }
};

}  // namespace

DVRLAB_PLUGIN("illumination", "blinn_phong", "1.0", BlinnPhong, parameters,
              "Blinn-Phong shading of the field's gradient, up to four lights",
              "J. Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977, "
              "doi:10.1145/563858.563893")
