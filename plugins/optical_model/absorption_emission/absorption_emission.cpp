// Absorption plus emission (Max 1995; Yang et al. 2012, equation 1), unshaded or Levoy-shaded.
#include <algorithm>

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
    {"pulses.count", integer, "", "0", "[0,256]",
     "A family of transfer functions in place of opacity and extinction: so many triangular pulses of opacity, evenly "
     "over the range of the data; 0: none.",
     Affects::pixels, R"({"optical_model":{"opacity":null,"pulses":{"count":3,"width":0.2,"height":0.5}}})", "5"},
    {"pulses.width", number, "value", "1", "(0,inf)", "Width of a pulse at its foot.", Affects::pixels,
     R"({"optical_model":{"opacity":null,"pulses":{"count":3,"width":0.2,"height":0.5}}})", "0.1"},
    {"pulses.height", number, "per dl_std", "0.5", "[0,1]", "Opacity at the top of a pulse.", Affects::pixels,
     R"({"optical_model":{"opacity":null,"pulses":{"count":3,"width":0.2,"height":0.5}}})", "0.9"},
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
  static Curve pulse_train(const ParameterSet& p, const ModelContext& context) {
    const auto count = static_cast<double>(p.integer("pulses.count"));
    const double height = p.number("pulses.height"), range = context.value_max - context.value_min;
    // Neighbours meet at their feet at the widest.
    const double half = std::min(p.number("pulses.width"), range / count) / 2;
    std::vector<Node> nodes;
    for (double k = 0; k < count; ++k) {
      const double centre = context.value_min + (k + 0.5) / count * range;
      nodes.insert(nodes.end(),
                   {{centre - half, {0, 0, 0}}, {centre, {height, height, height}}, {centre + half, {0, 0, 0}}});
    }
    return Curve(std::move(nodes));
  }

  // Per world unit.
  static Extinction extinction_curve(const ParameterSet& p, const ModelContext& context) {
    const bool pulses = p.integer("pulses.count") > 0;
    if (int(!p.is_null("opacity")) + int(!p.is_null("extinction")) + int(pulses) != 1)
      throw InputError(p.path() + ": give exactly one of opacity, extinction and pulses");
    if (pulses || !p.is_null("opacity"))
      return extinction_of(pulses ? pulse_train(p, context) : Curve(p.nodes("opacity")), nullptr,
                           p.number("dl_std") * context.length_unit, p.path_of(pulses ? "pulses" : "opacity"), context);
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
