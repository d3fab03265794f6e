// Absorption plus emission (Max 1995; Yang et al. 2012, equation 1), unshaded or Levoy-shaded.
#include "framework/interfaces/error.h"
#include "framework/interfaces/transfer_function.h"

namespace {
using namespace dvrlab;
using enum ParameterType;

const Parameter parameters[] = {
    {"opacity", nodes, "per dl_std", "null", "1|3",
     "Opacity nodes [value, a] or [value, r, g, b] in [0, 1] for a homogeneous length dl_std; this or extinction.",
     Affects::pixels, "", "[[0,0.02],[1,0.2]]"},
    {"extinction", nodes, "1/length", "null", "1|3",
     "Extinction nodes [value, mu] or [value, r, g, b] per length_unit; this or opacity.", Affects::pixels,
     R"({"optical_model":{"opacity":null,"extinction":[[0,0],[1,2]]}})", "[[0,0.5],[1,3]]"},
    {"color", nodes, "", "[[0,1,1,1]]", "3", "Colour nodes [value, r, g, b].", Affects::pixels, "",
     "[[0,0.1,0.5,0.9],[1,0.9,0.2,0.1]]"},
    {"emission", nodes, "radiance/length", "null", "3",
     "Emission nodes [value, r, g, b] per length_unit on top of colour times extinction (glow without extinction).",
     Affects::pixels, "", "[[0,0.3,0.1,0]]"},
    {"dl_std", number, "length_unit", "1", "(0,inf)", "Length that the opacity nodes refer to.", Affects::pixels, "",
     "0.5"},
    {"shaded", boolean, "", "false", "",
     "Levoy-shaded: colour times extinction is lit as a surface; otherwise it needs no normal.", Affects::pixels, "",
     "true"},
};

class AbsorptionEmission : public OpticalModelPlugin {
 public:
  Medium medium(const ParameterSet& p, const ModelContext& context) const override {
    const Extinction extinction = extinction_curve(p, context);
    const Curve color = color_curve(p.nodes("color"), context);
    const bool glows = !p.is_null("emission");
    const Curve emission = glows ? color_curve(p.nodes("emission"), context) : Curve(Vector3{0, 0, 0});
    std::vector<const Curve*> curves = {&extinction.curve, &color};
    if (glows) curves.push_back(&emission);
    MediumBuilder builder(curves);
    builder.add(Term::tau_l, extinction.curve);
    if (p.boolean("shaded")) {
      builder.add_product(Term::S_l, color, extinction.curve);
      builder.add(Term::W_l, extinction.curve);
    } else {
      builder.add_product(Term::P, color, extinction.curve);
    }
    if (glows) builder.add(Term::E, emission, 1.0 / context.length_unit);
    builder.add_opaque(extinction, color, p.boolean("shaded"));
    return builder.take();
  }

 private:
  // Per world unit.
  static Extinction extinction_curve(const ParameterSet& p, const ModelContext& context) {
    if (p.is_null("opacity") == p.is_null("extinction"))
      throw InputError(p.path() + ": give exactly one of opacity and extinction");
    if (!p.is_null("opacity"))
      return extinction_of(Curve(p.nodes("opacity")), nullptr, p.number("dl_std") * context.length_unit,
                           p.path_of("opacity"), context);
    Curve mu(p.nodes("extinction"));
    for (Node& n : mu.nodes()) {
      for (double& x : n.x) {
        if (x < 0)
          throw InputError(p.path_of("extinction") + ": negative extinction at value " + std::to_string(n.value));
        x /= context.length_unit;
      }
    }
    return {std::move(mu), {}};
  }
};

}  // namespace

DVRLAB_PLUGIN("optical_model", "absorption_emission", "1.0", AbsorptionEmission, parameters,
              "absorption and emission per unit length, grey or RGB extinction, unshaded or Levoy-shaded",
              "N. Max, Optical Models for Direct Volume Rendering, TVCG 1(2), 1995, doi:10.1109/2945.468400; "
              "M. Levoy, Display of Surfaces from Volume Data, CG&A 8(3), 1988, doi:10.1109/38.511")
