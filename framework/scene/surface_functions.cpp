#include "framework/interfaces/surface_functions.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/config/check_value.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

using nlohmann::json;

constexpr double opaque_depth = 16.6;  // math section 0: of a capped isosurface

Extinction surface_extinction(const ParameterSet& p, const ModelContext& context) {
  if (p.is_null("surface.opacity")) return {Curve(Vector3{0, 0, 0}), {}};
  return extinction_of(Curve(p.nodes("surface.opacity")), nullptr, p.number("dv_std"), p.path_of("surface.opacity"),
                       context);
}

Curve surface_color(const ParameterSet& p, const Curve* shared, const ModelContext& context) {
  if (!p.is_null("surface.color")) return color_curve(p.nodes("surface.color"), context);
  return shared != nullptr ? *shared : Curve(Vector3{1, 1, 1});
}

bool number_in_0_1(const json& x) { return x.is_number() && x.get<double>() >= 0 && x.get<double>() <= 1; }
bool color(const json& x) {
  return x.is_array() && x.size() == 3 && std::all_of(x.begin(), x.end(), [](const json& c) { return c.is_number(); });
}

std::string wrong_delta(const json& d) {
  if (!d.is_object())
    return "found " + short_text(d) + "; must be {\"value\": v, \"opacity\": a, \"color\": [r, g, b]}";
  for (const auto& [key, x] : d.items())
    if (key != "value" && key != "opacity" && key != "color")
      return "unknown key '" + key + "'; legal: color, opacity, value";
  if (!d.contains("value") || !d["value"].is_number()) return "'value' must be a number, the isosurface's value";
  if (!d.contains("opacity") || !number_in_0_1(d["opacity"])) return "'opacity' must be a number in [0, 1]";
  if (d.contains("color") && !color(d["color"])) return "'color' must be three numbers [r, g, b]";
  return "";
}

}  // namespace

void SurfaceFunctions::check(const ParameterSet& p) {
  const std::string path = p.path_of("surface.delta");
  const json& list = p.json("surface.delta");
  if (!list.is_array()) throw InputError(path + ": found " + short_text(list) + "; must be a list of isosurfaces");
  for (std::size_t k = 0; k < list.size(); ++k)
    if (const std::string wrong = wrong_delta(list[k]); !wrong.empty())
      throw InputError(path + "[" + std::to_string(k) + "]: " + wrong);
  if (list.empty()) require_amount(p, "surface.color", "surface.opacity");
}

SurfaceFunctions::SurfaceFunctions(const ParameterSet& p, const Curve* shared_color, const ModelContext& context)
    : extinction_(surface_extinction(p, context)),
      color_(surface_color(p, shared_color, context)),
      cap_(context.opaque == ModelContext::Opaque::cap) {
  for (const json& d : p.json("surface.delta")) {
    Delta delta{d["value"].get<double>(), d["opacity"].get<double>(), {}};
    delta.color = color_.at(delta.value);
    if (d.contains("color")) {
      delta.color = d["color"].get<Vector3>();
      if (context.linear_color)
        for (double& x : delta.color) x = display_to_linear(x);
    }
    delta_.push_back(delta);
    if (delta.opacity >= 1 && cap_)
      context.notes->push_back(p.path_of("surface.delta") + ": an opaque isosurface is capped at the depth 16.6");
  }
}

void SurfaceFunctions::add_to(MediumBuilder& builder) const {
  builder.add(Term::tau_s, extinction_.curve);
  builder.add_product(Term::S_s, color_, extinction_.curve);
  builder.add(Term::W_s, extinction_.curve);
  builder.add_opaque(extinction_, color_, true);
  for (const Delta& d : delta_) {
    const double mu = d.opacity < 1 ? -std::log1p(-d.opacity) : opaque_depth;
    if (d.opacity >= 1 && !cap_)
      builder.add_opaque_isosurface(d.value, d.color);
    else if (mu > 0)
      builder.add_dirac({d.value, {mu, mu, mu}, d.color});
  }
}

}  // namespace dvrlab
