// Local Blinn-Phong shading with up to four lights: fills the parameters of the framework's shading kernel.
#include "framework/interfaces/illumination.h"

namespace {
using namespace dvrlab;
using enum ParameterType;

const Parameter parameters[] = {
    {"ambient", number, "", "0.2", "[0,inf)", "k_a: factor of the colour without any light.", Affects::pixels, "",
     "0.4"},
    {"diffuse", number, "", "0.7", "[0,inf)", "k_d: factor of |N.L|.", Affects::pixels, "", "0.3"},
    {"specular", number, "", "0.3", "[0,inf)", "k_s: factor of |N.H|^shininess, added uncoloured.", Affects::pixels, "",
     "0.1"},
    {"shininess", integer, "", "20", "[1,1024]", "Exponent of the highlight: a whole number.", Affects::pixels, "",
     "5"},
    {"two_sided", boolean, "", "true", "", "Both sides of a surface are lit; otherwise only the one facing the light.",
     Affects::pixels, "", "false"},
    {"gradient_eps", number, "value/length", "1e-6", "[0,inf)",
     "Gradient magnitude (physical value per world unit) below which there is no normal: k = ambient + diffuse.",
     Affects::pixels, "", "1000"},
};

class BlinnPhong : public IlluminationPlugin {
 public:
  void shade(const ParameterSet& p, LocalShading& s) const override {
    s.mode = LocalShading::Mode::blinn_phong;
    s.ambient = p.number("ambient");
    s.diffuse = p.number("diffuse");
    s.specular = p.number("specular");
    s.shininess = static_cast<int>(p.integer("shininess"));
    s.two_sided = p.boolean("two_sided");
    s.gradient_eps = p.number("gradient_eps");
  }
};

}  // namespace

DVRLAB_PLUGIN("illumination", "blinn_phong", "1.0", BlinnPhong, parameters,
              "Blinn-Phong shading of the field's gradient, up to four lights",
              "J. Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977, "
              "doi:10.1145/563858.563893")
