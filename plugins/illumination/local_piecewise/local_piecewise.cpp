// Global light propagation by local piecewise integration (Hernell et al. 2008): plans the stages of its four kernels.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/interfaces/light_keys.h"
#include "framework/interfaces/transfer_function.h"
#include "framework/scene/buffers.h"

namespace dvrlab::local_piecewise {
namespace {

using enum ParameterType;
constexpr Affects pixels = Affects::pixels;

const Parameter parameters[] = {
    {"segment", number, "voxel", "8", "(0,inf)", "Length of the local segments: the step of the way to the light.",
     pixels, "", "3"},
    {"segment_samples", integer, "", "0", "[0,4096]", "Samples of a local segment; 0: one per voxel of its length.",
     pixels, "", "2"},
    {"shadow_ratio", integer3, "", "[4,4,4]", "[1,16]",
     "Voxels per point of the shadow volume along x, y, z; the light's whole way is integrated at the full resolution.",
     pixels, "", "[1,1,1]"},
    {"first_segment", choice, "", "\"piecewise\"", "piecewise|interpolated",
     "Direct light of a voxel: its own local segment and the shadow volume behind it, or the shadow volume alone "
     "(figure 1d, "
     "1c).",
     pixels, "", "\"interpolated\""},
    {"components", choice, "", "\"scattered\"", "scattered|direct|sum",
     "What lights the volume: light scattered once (the paper's), direct light, or both.", pixels, "", "\"sum\""},
    {"normalisation", choice, "", "\"lao\"", "lao|physical",
     "lao: an unoccluded voxel in uniform light has as much scattered light; physical: matter scatters albedo times "
     "its "
     "extinction.",
     pixels, "", "\"physical\"", "components=scattered|sum"},
    {"albedo", number, "", "1", "[0,1]", "Part of the extinction that scatters.", pixels,
     R"({"illumination":{"normalisation":"physical"}})", "0.5", "normalisation=physical"},
    {"radius", number, "voxel", "16", "(0,inf)", "Radius of the sphere that light is scattered from.", pixels, "", "5",
     "components=scattered|sum"},
    {"samples", integer, "", "8", "[1,1024]", "Samples along each direction.", pixels, "", "3",
     "components=scattered|sum"},
    {"solid", choice, "", "\"octahedron\"", "tetrahedron|octahedron|icosahedron",
     "Directions are the centres of its faces: 4, 8 or 20; one of them points at the first light.", pixels, "",
     "\"icosahedron\"", "components=scattered|sum"},
    {"subdivisions", integer, "", "1", "[0,3]",
     "How often each face is cut into four: 32 directions are the octahedron once.", pixels, "", "0",
     "components=scattered|sum"},
    {"weights", choice, "", "\"equal\"", "equal|solid_angle",
     "Weights of the directions: all alike, or the solid angles of their faces.", pixels, "", "\"solid_angle\"",
     "components=scattered|sum"},
    {"phase", choice, "", "\"isotropic\"", "isotropic|henyey_greenstein", "Phase function.", pixels, "",
     "\"henyey_greenstein\"", "components=scattered|sum"},
    {"g", number, "", "0.5", "(-1,1)", "Mean cosine of the scattering angle; positive: forward.", pixels,
     R"({"illumination":{"phase":"henyey_greenstein"}})", "-0.3", "phase=henyey_greenstein"},
    {"g_of_value", json, "", "null", "null or [[value, g], ...] with ascending values and g in (-1, 1)",
     "The same as a function of the value at the voxel, linear in between, in place of g.", pixels,
     R"({"illumination":{"phase":"henyey_greenstein"}})", "[[0,0.8],[1,-0.8]]", "phase=henyey_greenstein",
     R"({"type":["array","null"],"items":{"type":"array","items":{"type":"number"},"minItems":2,"maxItems":2}})"},
    {"orders", integer, "", "1", "[1,64]",
     "How often light is scattered: what came of one order is scattered again (isotropic phase function only).", pixels,
     "", "2", "components=scattered|sum"},
    {"directions_done", integer, "", "0", "[0,1280]",
     "Progressive refinement: the mean over so many first directions, the light's own before all; 0: all.", pixels, "",
     "3", "components=scattered|sum"},
    {"progressive", boolean, "", "false", "",
     "One stage per direction, so that the next frame goes on where this one ended, and each is timed.", Affects::speed,
     "", "true", "components=scattered|sum"},
    light_opacity_scale_key,
    light_bias_key,
    light_blend_key,
    light_storage_key,
    light_resolution_key,
};

/// The nodes of g_of_value; none where it is not read.
std::vector<Node> lobes_of(const ParameterSet& p) {
  std::vector<Node> nodes;
  if (p.text("components") == "direct" || p.text("phase") != "henyey_greenstein" || p.is_null("g_of_value"))
    return nodes;
  for (const nlohmann::json& row : p.json("g_of_value")) {
    const bool numbers = row.is_array() && row.size() == 2 && row[0].is_number() && row[1].is_number();
    if (!numbers || std::abs(row[1].get<double>()) >= 1 ||
        (!nodes.empty() && row[0].get<double>() < nodes.back().value))
      throw InputError(p.path_of("g_of_value") + ": found " + row.dump() +
                       "; give [value, g] with ascending values and g in (-1, 1)");
    const double g = row[1].get<double>();
    nodes.push_back({row[0].get<double>(), {g, g, g}});
  }
  return nodes;
}

class Planner {
 public:
  Planner(const ParameterSet& p, const LightSetting& s) : p_(p), s_(s) {
    segment_ = p.number("segment") * s.voxel;
    const auto given = static_cast<int>(p.integer("segment_samples"));
    segment_samples_ = given != 0 ? given : std::max(1, static_cast<int>(std::lround(p.number("segment"))));
    const std::array<int, 3> ratio = p.integer3("shadow_ratio");
    for (std::size_t a = 0; a < 3; ++a) coarse_[a] = std::max(2, (s.dims[a] - 1 + ratio[a] - 1) / ratio[a] + 1);
    scatters_ = p.text("components") != "direct";
    if (scatters_) plan_directions();
  }

  LightPlan plan() {
    plan_ = light_plan(p_);
    const int step = s_.lights_per_volume();
    for (int first = 0; first < static_cast<int>(s_.light.size()); first += step) {
      const int direct = add_direct(first);
      LightPart part{{}, first};
      if (p_.text("components") != "scattered") part.stages.push_back(direct);
      if (scatters_) add_scattered(first, direct, part);
      plan_.parts.push_back(part);
    }
    return std::move(plan_);
  }

 private:
  /// `rounds`: of a voxel's loops, per channel.
  int add(const char* kernel, const std::string& label, const LightGrid& grid, int first, double rounds,
          std::vector<Uniform> uniforms, std::vector<StageRead> reads, std::vector<Buffer> buffers = {}) {
    LightStage stage;
    stage.kernel = std::string("local_piecewise_") + kernel;
    stage.label =
        label + (s_.light.size() > std::size_t(s_.lights_per_volume()) ? " " + std::to_string(first + 1) : "");
    stage.grid = grid;
    stage.first_light = first;
    stage.long_loops = rounds * stage.grid.channels > most_rounds;
    stage.uniforms = std::move(uniforms);
    stage.reads = std::move(reads);
    stage.buffers = std::move(buffers);
    plan_.stages.push_back(std::move(stage));
    return static_cast<int>(plan_.stages.size()) - 1;
  }

  int add_direct(int first) {
    const bool own = p_.text("first_segment") == "piecewise";
    const LightGrid here = s_.points(s_.channels_from(first)), coarse{coarse_, here.channels};
    const int segments = add("segment", "segment", here, first, segment_samples_,
                             {Uniform::real("local_piecewise_segment_length", segment_),
                              Uniform::integer("local_piecewise_segment_samples", segment_samples_)},
                             {});
    shadow_ = add("shadow", "shadow", coarse, first, s_.box_diagonal / segment_,
                  {Uniform::real("local_piecewise_shadow_length", segment_)},
                  {{"local_piecewise_shadow_segments", segments}});
    return add(
        "direct", "direct", here, first, 0,
        {Uniform::real("local_piecewise_direct_length", segment_),
         Uniform::constant_integer("local_piecewise_direct_first", own ? 1 : 0)},
        {{"local_piecewise_direct_segments", own ? segments : -1}, {"local_piecewise_direct_shadow", shadow_, true}});
  }

  void plan_directions() {
    directions_ = dvrlab::light_directions(p_, towards(s_.light.front()));
    const auto wanted = static_cast<std::size_t>(p_.integer("directions_done"));
    if (wanted > directions_.size())
      throw InputError(p_.path_of("directions_done") + ": found " + std::to_string(wanted) + "; there are " +
                       std::to_string(directions_.size()) + " directions, and 0 stands for all");
    directions_done_ = static_cast<int>(wanted != 0 ? wanted : directions_.size());
    double sum = 0;
    for (const LightDirection& d : directions_) {
      const Vector3 toward = s_.sampler_direction(d.omega);
      sum += d.weight;
      table_.insert(table_.end(),
                    {toward[0], toward[1], toward[2], d.weight, d.omega[0], d.omega[1], d.omega[2], d.weight / sum});
    }
    const std::vector<Node> g = lobes_of(p_);
    if (!g.empty()) {
      const Curve curve(g);
      for (int e = 0; e < s_.entries; ++e)
        gs_.push_back(curve.at(s_.value_lo + (s_.value_hi - s_.value_lo) * e / (s_.entries - 1))[0]);
    }
  }

  void add_scattered(int first, int direct, LightPart& part) {
    const bool physical = p_.text("normalisation") == "physical";
    int light = direct, scattered = -1;
    for (int order = 1; order <= p_.integer("orders"); ++order) {
      // What is scattered once more: the light of the last order; the physical sum begins with the direct light anew.
      scattered =
          add_order(first, order, order > 1 && !physical ? scattered : light, order > 1 && physical ? scattered : -1);
    }
    part.stages.push_back(scattered);
  }

  int add_order(int first, int order, int light, int more) {
    const auto samples = static_cast<int>(p_.integer("samples"));
    const int count = directions_done_;
    const int at_once = p_.boolean("progressive") ? 1 : std::clamp(static_cast<int>(most_rounds) / samples, 1, count);
    int before = -1;
    for (int from = 0; from < count; from += at_once) {
      const int to = std::min(from + at_once, count);
      std::string label = order > 1 ? "scatter, order " + std::to_string(order) : "scatter";
      if (at_once < count) label += ", directions " + std::to_string(from + 1) + " to " + std::to_string(to);
      before = add(
          "scatter", label, s_.points(s_.channels_from(first)), first, 0, scatter_uniforms(from, to, more >= 0, order),
          {{"local_piecewise_scatter_light", light},
           {"local_piecewise_scatter_shadow", shadow_, true},
           {"local_piecewise_scatter_more", more},
           {"local_piecewise_scatter_before", before}},
          {vec4_buffer("local_piecewise_scatter_direction", table_), real_buffer("local_piecewise_scatter_gs", gs_)});
    }
    return before;
  }

  std::vector<Uniform> scatter_uniforms(int from, int to, bool adds, int order) const {
    const bool physical = p_.text("normalisation") == "physical";
    const auto samples = static_cast<int>(p_.integer("samples"));
    const bool lobes = p_.text("phase") == "henyey_greenstein" && order == 1;
    const auto integer = [](const char* name, int value) {
      return Uniform::integer(std::string("local_piecewise_scatter_") + name, value);
    };
    const auto constant = [](const char* name, int value) {
      return Uniform::constant_integer(std::string("local_piecewise_scatter_") + name, value);
    };
    const auto real = [](const char* name, double value) {
      return Uniform::real(std::string("local_piecewise_scatter_") + name, value);
    };
    return {integer("first", from),
            integer("last", to),
            integer("samples", samples),
            constant("adds", adds ? 1 : 0),
            constant("physical", physical ? 1 : 0),
            constant("phase", !lobes        ? 0
                              : gs_.empty() ? 1
                                            : 2),
            real("part", p_.number("radius") * s_.voxel / samples),
            real("scale", physical ? p_.number("albedo") : 1.0 / samples),
            real("g", lobes ? p_.number("g") : 0)};
  }

  const ParameterSet& p_;
  const LightSetting& s_;
  double segment_;
  int segment_samples_;
  std::array<int, 3> coarse_{};
  bool scatters_;
  std::vector<LightDirection> directions_;
  int directions_done_ = 0;
  int shadow_ = -1;  // the stage of the shadow volume
  std::vector<double> table_, gs_;
  LightPlan plan_;
};

class LocalPiecewise : public LightPass {
 public:
  void check(const ParameterSet& p) const override {
    lobes_of(p);
    if (p.text("components") == "direct" || p.text("phase") == "isotropic" || p.integer("orders") == 1) return;
    throw InputError(
        p.path_of("orders") +
        ": light that was scattered has no direction any more, so further orders are isotropic only; set phase "
        "to \"isotropic\", or orders to 1");
  }
  LightPlan plan(const ParameterSet& p, const LightSetting& s) const override {
    require_lights(p, s);
    return Planner(p, s).plan();
  }
};

}  // namespace

DVRLAB_PLUGIN(
    "illumination", "local_piecewise", "1.0", LocalPiecewise, parameters,
    "global light and first-order scattering by local piecewise integration, as a light volume",
    "F. Hernell, P. Ljung, A. Ynnerman, Interactive Global Light Propagation in Direct Volume Rendering using Local "
    "Piecewise Integration, IEEE/EG Symposium on Volume and Point-Based Graphics 2008, "
    "doi:10.2312/VG/VG-PBG08/105-112")

}  // namespace dvrlab::local_piecewise
