// The continuous model of Williams and Max 1992: a glowing gas with an optical density and a chromaticity per colour
// channel.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/config/check_value.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/transfer_function.h"

namespace dvrlab::volume_density {
namespace {

using enum ParameterType;
constexpr Affects pixels = Affects::pixels;

constexpr const char* channel_patch =
    R"({"optical_model":{"density":[[0,0.3],[1,0.2]],"chromaticity":[[0,0.2,0.4,1],[1,1,0.5,0.2]]}})";

constexpr Parameter parameters[] = {
    {"density", nodes, "1/length", "null", "1|3",
     "Optical density rho: nodes [value, rho], one for all channels, or [value, r, g, b]; per length_unit, or in [0, "
     "1] "
     "with form normalised.",
     pixels, "", "[[0,0.1,0.1,0.3],[1,2,1,0.5]]"},
    {"chromaticity", nodes, "", "null", "1|3", "Chromaticity kappa: nodes [value, kappa] or [value, r, g, b].", pixels,
     "", "[[0,1,0.5,0.2],[1,0.1,0.6,0.9]]"},
    {"red.density", nodes, "1/length", "null", "1", "Density of the red channel with nodes of its own.", pixels,
     channel_patch, "[[0,1],[0.5,0]]"},
    {"green.density", nodes, "1/length", "null", "1", "Density of the green channel.", pixels, channel_patch,
     "[[0,1],[0.5,0]]"},
    {"blue.density", nodes, "1/length", "null", "1", "Density of the blue channel.", pixels, channel_patch,
     "[[0,1],[0.5,0]]"},
    {"red.chromaticity", nodes, "", "null", "1", "Chromaticity of the red channel with nodes of its own.", pixels,
     channel_patch, "[[0,1],[0.5,0]]"},
    {"green.chromaticity", nodes, "", "null", "1", "Chromaticity of the green channel.", pixels, channel_patch,
     "[[0,1],[0.5,0]]"},
    {"blue.chromaticity", nodes, "", "null", "1", "Chromaticity of the blue channel.", pixels, channel_patch,
     "[[0,1],[0.5,0]]"},
    {"form", choice, "", R"("extinction")", "extinction|normalised",
     "extinction: rho and kappa as they are, from 0 to infinity; normalised: 1 - exp(-rho) and 1 - exp(-kappa), from 0 "
     "to "
     "1, over one length_unit.",
     pixels, R"({"optical_model":{"density":[[0,0.3],[1,0.2]],"chromaticity":[[0,0.2],[1,0.9]]}})", R"("normalised")"},
    {"emission", choice, "", R"("associated")", "associated|independent",
     "associated: matter emits kappa rho per length, so thin matter glows little; independent: kappa per length, "
     "whatever "
     "the density (Wilhelms and Van Gelder 1991).",
     pixels, "", R"("independent")"},
    {"shaded", json, "", "[]",
     "a list of {\"from\": v0, \"to\": v1, \"as\": \"source\" | \"dirac\" (optional), \"thickness\": length (dirac, "
     "optional)}",
     "Intervals of values that are shown as surfaces: their emission is shaded (source), or all of their matter "
     "becomes a "
     "discrete isosurface of the depth that it has over the thickness, 1 length_unit by default, per unit of value "
     "(dirac).",
     pixels, R"({"illumination":[{"type":"blinn_phong"}]})", R"([{"from":0.4,"to":0.6}])", "",
     R"({"type":"array","items":{"type":"object","properties":{"from":{"type":"number"},"to":{"type":"number"},"as":{"enum":["source","dirac"]},"thickness":{"type":"number","exclusiveMinimum":0}},"required":["from","to"],"additionalProperties":false}})"},
};

constexpr const char* channels[] = {"red", "green", "blue"};

/// A curve whose channels are three curves' first ones.
Curve joined(const std::array<Curve, 3>& parts) {
  std::vector<double> breaks;
  for (const Curve& c : parts) {
    const auto b = c.breaks();
    breaks.insert(breaks.end(), b.begin(), b.end());
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  std::vector<Node> nodes;
  for (const double v : breaks) {
    Vector3 left, right;
    for (std::size_t c = 0; c < 3; ++c) {
      left[c] = parts[c].at(v, true)[c];
      right[c] = parts[c].at(v)[c];
    }
    if (left != right) nodes.push_back({v, left});
    nodes.push_back({v, right});
  }
  return Curve(std::move(nodes));
}

void refuse_below_zero(const Nodes& nodes, const std::string& path) {
  for (const Node& n : nodes.node)
    for (const double x : n.x)
      if (x < 0)
        throw InputError(path + ": " + nlohmann::json(x).dump() + " at value " + nlohmann::json(n.value).dump() +
                         "; must be at least 0");
}

struct Flagged {
  double from, to, thickness;
  bool dirac;
};

/// What is wrong with an item of `shaded`, to be put behind its path; "" when it can be read.
std::string wrong_interval(const nlohmann::json& item) {
  if (!item.is_object()) return ": found " + short_text(item) + "; must be {\"from\": v0, \"to\": v1}";
  for (const auto& [key, x] : item.items())
    if (key != "from" && key != "to" && key != "as" && key != "thickness")
      return ": unknown key '" + key + "'; legal: as, from, thickness, to";
  for (const char* end : {"from", "to"})
    if (!item.contains(end) || !item[end].is_number())
      return ": '" + std::string(end) + "' must be a number, an end of the interval of values";
  if (item.contains("as") && item["as"] != "source" && item["as"] != "dirac")
    return ".as: found " + short_text(item["as"]) + "; must be one of source, dirac";
  if (item.contains("thickness") && !(item["thickness"].is_number() && item["thickness"].get<double>() > 0))
    return ".thickness: found " + short_text(item["thickness"]) + "; must be a number in (0,inf)";
  return "";
}

std::vector<Flagged> flagged(const ParameterSet& p) {
  const nlohmann::json& items = p.json("shaded");
  if (!items.is_array())
    throw InputError(p.path_of("shaded") + ": found " + short_text(items) + "; must be a list of intervals");
  std::vector<Flagged> list;
  for (const nlohmann::json& item : items) {
    const std::string where = p.path_of("shaded") + "[" + std::to_string(list.size()) + "]";
    if (const std::string wrong = wrong_interval(item); !wrong.empty()) throw InputError(where + wrong);
    Flagged f{item.at("from").get<double>(), item.at("to").get<double>(), item.value("thickness", 1.0),
              item.value("as", std::string("source")) == "dirac"};
    if (!(f.from < f.to)) throw InputError(where + ": from must be less than to");
    for (const Flagged& other : list)
      if (f.from < other.to && other.from < f.to) throw InputError(where + ": overlaps an earlier interval");
    if (!f.dirac && item.contains("thickness"))
      throw InputError(where + ".thickness: is read only with \"as\": \"dirac\"");
    list.push_back(f);
  }
  return list;
}

/// Density or chromaticity: the shared curve, in which channels may have their own.
struct Amount {
  const ParameterSet& p;
  const std::string key;  // "density"

  bool given() const {
    bool any = !p.is_null(key);
    for (const char* c : channels) any = any || !p.is_null(c + ("." + key));
    return any;
  }
  bool per_channel() const {
    return std::any_of(std::begin(channels), std::end(channels),
                       [&](const char* c) { return !p.is_null(c + ("." + key)); });
  }
  void check() const {
    for (int c = -1; c < 3; ++c) {
      const std::string name = c < 0 ? key : channels[c] + ("." + key);
      if (!p.is_null(name)) refuse_below_zero(p.nodes(name), p.path_of(name));
      if (c >= 0 && p.is_null(name) && p.is_null(key) && given())
        throw InputError(p.path_of(name) + ": the other channels have a " + key + "; give this one its own, or " + key +
                         " for all");
    }
  }
  /// What `convert` makes of the nodes of each curve: (curve, path) -> Curve.
  template <class Convert>
  Curve curve(Convert convert) const {
    if (!per_channel()) return convert(Curve(p.nodes(key)), p.path_of(key));
    std::array<Curve, 3> parts{Curve(Vector3{}), Curve(Vector3{}), Curve(Vector3{})};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::string name = channels[c] + ("." + key);
      const std::string& own = p.is_null(name) ? key : name;
      parts[c] = convert(Curve(p.nodes(own)), p.path_of(own));
    }
    return joined(parts);
  }
};

class VolumeDensity : public OpticalModelPlugin {
 public:
  void check(const ParameterSet& p) const override {
    const Amount density{p, "density"}, chromaticity{p, "chromaticity"};
    if (!density.given())
      throw InputError(p.path_of("density") + ": give it, or red.density, green.density and blue.density");
    density.check();
    chromaticity.check();
    flagged(p);
    if (p.text("form") == "normalised" && chromaticity.given()) {
      for (int c = -1; c < 3; ++c) {
        const std::string name = c < 0 ? "chromaticity" : channels[c] + std::string(".chromaticity");
        if (p.is_null(name)) continue;
        for (const Node& n : p.nodes(name).node)
          if (std::max({n.x[0], n.x[1], n.x[2]}) >= 1)
            throw InputError(p.path_of(name) + ": 1 or more at value " + nlohmann::json(n.value).dump() +
                             "; normalised, only what is less than 1 is finite");
      }
    }
  }

  Medium medium(const ParameterSet& p, const ModelContext& context) const override {
    const bool normalised = p.text("form") == "normalised";
    Extinction density{Curve(Vector3{}), {}};
    density.curve = Amount{p, "density"}.curve([&](const Curve& c, const std::string& path) {
      if (normalised) {
        const Extinction e = extinction_of(c, nullptr, context.length_unit, path, context);
        density.opaque.insert(density.opaque.end(), e.opaque.begin(), e.opaque.end());
        return e.curve;
      }
      Curve per_world = c;
      for (Node& n : per_world.nodes())
        for (double& x : n.x) x /= context.length_unit;
      return per_world;
    });
    if (Amount{p, "density"}.per_channel()) density.opaque.clear();  // opaque in one channel only: capped there
    const Amount chroma{p, "chromaticity"};
    const Curve color =
        !chroma.given() ? Curve(Vector3{1, 1, 1}) : chroma.curve([&](const Curve& c, const std::string& path) {
          // 1 - exp(-kappa) has the form of an opacity over a length of 1.
          return normalised ? extinction_of(c, nullptr, 1, path, context).curve : c;
        });
    const std::vector<Flagged> surfaces = flagged(p);
    std::vector<double> borders;
    for (const Flagged& f : surfaces) borders.insert(borders.end(), {f.from, f.to});
    MediumBuilder builder({&density.curve, &color});
    builder.add(Term::tau_l, density.curve);
    if (p.text("emission") == "associated")
      builder.add_product(Term::E, color, density.curve);
    else
      builder.add(Term::E, color, 1 / context.length_unit);
    builder.add_opaque(density, color, false);
    return with_surfaces(builder.take().split_at(borders), surfaces, context.length_unit);
  }

 private:
  /// Flagged intervals: the source becomes a shaded one, or matter and source become a Dirac term.
  static Medium with_surfaces(Medium m, const std::vector<Flagged>& surfaces, double length_unit) {
    std::vector<Dirac> diracs;
    for (const Flagged& f : surfaces) {
      Dirac d{0.5 * (f.from + f.to), {}, {}};
      for (MediumInterval& i : m.interval) {
        if (i.v0 < f.from || i.v1 > f.to) continue;
        for (int c = 0; c < 3; ++c) {
          const auto tau = static_cast<std::size_t>(column(Term::tau_l, c)),
                     e = static_cast<std::size_t>(column(Term::E, c));
          if (!f.dirac) {
            i.c[static_cast<std::size_t>(column(Term::S_l, c))] = i.c[e];
            i.c[static_cast<std::size_t>(column(Term::W_l, c))] = i.c[tau];
          } else {
            const double depth = integral(i, tau) * f.thickness * length_unit,
                         source = integral(i, e) * f.thickness * length_unit;
            d.mu[static_cast<std::size_t>(c)] += depth;
            d.c[static_cast<std::size_t>(c)] += source;
            i.c[tau] = {0, 0, 0};
          }
          i.c[e] = {0, 0, 0};
        }
      }
      if (!f.dirac) continue;
      for (std::size_t c = 0; c < 3; ++c) d.c[c] = d.mu[c] > 0 ? d.c[c] / d.mu[c] : 0;
      diracs.push_back(d);
    }
    MediumBuilder builder(std::move(m));
    for (const Dirac& d : diracs) builder.add_dirac(d);
    return builder.take();
  }
  static double integral(const MediumInterval& i, std::size_t c) {
    return (i.v1 - i.v0) * (i.c[c][0] + i.c[c][1] / 2 + i.c[c][2] / 3);
  }
};

}  // namespace

DVRLAB_PLUGIN("optical_model", "volume_density", "1.0", VolumeDensity, parameters,
              "a glowing gas with a density and a chromaticity per colour channel: six transfer functions",
              "P. Williams and N. Max, A Volume Density Optical Model, Workshop on Volume Visualization 1992, "
              "doi:10.1145/147130.147151")

}  // namespace dvrlab::volume_density
