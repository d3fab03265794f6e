// Particles and surface elements in one medium (Yang et al. 2012, equations 4 to 10 and 24 to 27).
#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/interfaces/error.h"
#include "framework/interfaces/surface_functions.h"

namespace dvrlab::hybrid {
namespace {

using enum ParameterType;
constexpr Affects pixels = Affects::pixels;

constexpr Parameter parameters[] = {
    surface_opacity_key,
    surface_color_key,
    surface_delta_key,
    {"scattering.opacity", nodes, "per dl_std", "null", "1",
     "Opacity nodes of isotropically scattering particles within a length dl_std.", pixels, "", "[[0,0.02],[1,0.2]]"},
    {"scattering.color", nodes, "", "null", "3", "Colour nodes of the scattering particles.", pixels, "",
     "[[0,0.1,0.5,0.9],[1,0.9,0.2,0.1]]"},
    {"absorption.density", nodes, "per dl_std", "null", "1",
     "Opacity nodes of selectively absorbing particles within a length dl_std.", pixels, "", "[[0,0.3],[1,0.1]]"},
    {"absorption.transmission_color", nodes, "", "null", "3",
     "Which part of each channel the absorbing particles let pass, in [0, 1]; without nodes: nothing.", pixels, "",
     "[[0,0.9,0.1,0.4],[1,0.2,0.8,0.6]]"},
    {"emission.intensity", nodes, "per dl_std", "null", "1",
     "Intensity nodes of purely emitting particles within a length dl_std: 0 to 2, or beyond.", pixels, "",
     "[[0,0.1],[1,0.4]]"},
    {"emission.color", nodes, "", "null", "3", "Colour nodes of the emitting particles.", pixels, "",
     "[[0,0.9,0.6,0.1],[1,0.1,0.2,0.8]]"},
    {"color", nodes, "", "null", "3", "Colour nodes of whatever has none of its own; without them: white.", pixels,
     R"({"optical_model":{"surface":{"color":null}}})", "[[0,0.2,0.9,0.1],[1,0.7,0.3,0.9]]"},
    {"dl_std", number, "length_unit", "1", "(0,inf)", "Length that the particles' opacities and intensities refer to.",
     pixels, "", "0.5"},
    dv_std_key};

class Hybrid : public OpticalModelPlugin {
 public:
  void check(const ParameterSet& p) const override {
    SurfaceFunctions::check(p);
    require_amount(p, "scattering.color", "scattering.opacity");
    require_amount(p, "absorption.transmission_color", "absorption.density");
    require_amount(p, "emission.color", "emission.intensity");
    if (p.is_null("absorption.transmission_color")) return;
    for (const Node& n : p.nodes("absorption.transmission_color").node)
      if (std::max({n.x[0], n.x[1], n.x[2]}) > 1)
        throw InputError(p.path_of("absorption.transmission_color") + ": more than 1 at value " +
                         nlohmann::json(n.value).dump() + "; matter that only absorbs lets at most everything pass");
  }

  Medium medium(const ParameterSet& p, const ModelContext& context) const override {
    const double dl = p.number("dl_std") * context.length_unit;
    const Curve white(Vector3{1, 1, 1}), nothing(Vector3{0, 0, 0});
    const Curve shared = p.is_null("color") ? white : color_curve(p.nodes("color"), context);
    const auto color = [&](const char* key) { return p.is_null(key) ? shared : color_curve(p.nodes(key), context); };
    const auto extinction = [&](const char* key, const Curve* transmission) {
      if (p.is_null(key)) return Extinction{nothing, {}};
      return extinction_of(Curve(p.nodes(key)), transmission, dl, p.path_of(key), context);
    };

    const SurfaceFunctions surface(p, &shared, context);
    const Extinction scattering = extinction("scattering.opacity", nullptr);
    const Curve scattering_color = color("scattering.color");
    // Transmission is a property of matter, not a display colour: it is never decoded.
    const Curve transmission =
        p.is_null("absorption.transmission_color") ? nothing : Curve(p.nodes("absorption.transmission_color"));
    const Extinction absorption = extinction("absorption.density", &transmission);
    const Curve intensity = p.is_null("emission.intensity") ? nothing : Curve(p.nodes("emission.intensity"));
    Curve emission_color = color("emission.color");
    for (Node& n : emission_color.nodes())
      for (double& x : n.x) x /= dl;

    std::vector<const Curve*> curves = surface.curves();
    curves.insert(curves.end(), {&scattering.curve, &scattering_color, &absorption.curve, &intensity, &emission_color});
    MediumBuilder builder(curves);
    surface.add_to(builder);
    builder.add(Term::tau_l, scattering.curve);
    builder.add_product(Term::P, scattering_color, scattering.curve);
    builder.add_opaque(scattering, scattering_color, false);
    builder.add(Term::tau_l, absorption.curve);
    builder.add_opaque(absorption, nothing, false);
    builder.add_product(Term::E, emission_color, intensity);
    return builder.take();
  }
};

}  // namespace

DVRLAB_PLUGIN(
    "optical_model", "hybrid", "1.0", Hybrid, parameters,
    "particles that scatter, absorb and emit, and surface elements, from four pairs of transfer functions",
    "F. Yang, Q. Li, D. Xiang, Y. Cao, J. Tian, A Versatile Optical Model for Hybrid Rendering of Volume Data, "
    "TVCG 18(6), 2012, doi:10.1109/TVCG.2011.113")

}  // namespace dvrlab::hybrid
