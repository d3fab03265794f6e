// Single and multiple scattering by random walks, without bias and with its standard error: what the approximations are
// measured against.
#include <algorithm>

#include "framework/interfaces/light_keys.h"
#include "framework/scene/buffers.h"

namespace dvrlab::path_traced {
namespace {

using enum ParameterType;
constexpr Affects pixels = Affects::pixels;

/// An image has no volume that could be stored.
constexpr Parameter storage_key = [] {
  Parameter key = light_storage_key;
  key.only_with = "target=volume";
  return key;
}();

const Parameter parameters[] = {
    {"target", choice, "", "\"volume\"", "volume|image",
     "volume: the light at every voxel; image: the picture itself, from random walks that begin at the camera.", pixels,
     "", "\"image\""},
    {"samples", integer, "", "64", "[2,16777216]", "Random walks per voxel or pixel, and light.", pixels, "", "32"},
    {"components", choice, "", "\"sum\"", "sum|direct|scattered",
     "What is counted: light that was scattered, that was not, or both.", pixels, "", "\"scattered\""},
    {"orders", integer, "", "0", "[0,1000000]", "Scatterings at the most; 0: any number.", pixels, "", "1",
     "components=sum|scattered"},
    {"albedo", number, "", "1", "[0,1]", "Part of the extinction that scatters.", pixels, "", "0.5",
     "components=sum|scattered"},
    {"phase", choice, "", "\"isotropic\"", "isotropic|henyey_greenstein", "Phase function.", pixels, "",
     "\"henyey_greenstein\"", "components=sum|scattered"},
    {"g", number, "", "0.5", "(-1,1)", "Mean cosine of the scattering angle; positive: forward.", pixels,
     R"({"illumination":{"phase":"henyey_greenstein"}})", "-0.3", "phase=henyey_greenstein"},
    {"environment", number, "", "0", "[0,inf)", "Light from all around the box, as a fluence relative to the lights'.",
     pixels, "", "0.5", "components=sum|scattered"},
    light_opacity_scale_key,
    light_bias_key,
    light_blend_key,
    storage_key,
    light_resolution_key,
};

class Planner {
 public:
  Planner(const ParameterSet& p, const LightSetting& s) : p_(p), s_(s) {}

  LightPlan plan() {
    plan_ = light_plan(p_);
    image_ = p_.text("target") == "image";
    for (int light = 0; light < static_cast<int>(s_.light.size()); ++light)
      for (int color = 0; color < (s_.rgb ? 3 : 1); ++color) add(light, color);
    return std::move(plan_);
  }

 private:
  void add(int light, int color) {
    if (image_)
      plan_.image.push_back(light);
    else
      add_part(light, color);
    LightStage stage;
    stage.kernel = "path_traced_walk";
    stage.label = "walk";
    if (plan_.stages.size() > 0 || s_.rgb || s_.light.size() > 1)
      stage.label += " " + std::to_string(light + 1) + (s_.rgb ? std::string(1, "rgb"[color]) : "");
    // The standard error of a pixel is that of independent estimates.
    const auto samples = static_cast<int>(p_.integer("samples"));
    const int estimates = image_ ? std::clamp(samples / 2, 2, 8) : 1;
    const auto [width, height] = s_.image_size;
    stage.grid = image_ ? LightGrid{{width, height, estimates}, 4} : s_.points(2);
    stage.first_light = light;
    stage.long_loops = true;
    add_walk(stage, light, color, (samples + estimates - 1) / estimates);
    add_view(stage, light);
    plan_.stages.push_back(std::move(stage));
  }

  void add_part(int light, int color) {
    LightPart part;
    part.stages = {static_cast<int>(plan_.stages.size())};
    part.first_light = light;
    part.clamp = false;
    part.error = true;
    part.color = s_.rgb ? color : -1;
    plan_.parts.push_back(part);
  }

  static Uniform integer_of(const char* name, int value) {
    return Uniform::integer(std::string("path_traced_walk_") + name, value);
  }
  static Uniform real_of(const char* name, double value) {
    return Uniform::real(std::string("path_traced_walk_") + name, value);
  }

  void add_walk(LightStage& stage, int light, int color, int samples) const {
    // An empty medium still has flights, far longer than the box.
    const double largest = s_.largest_tau[std::size_t(color)] * plan_.opacity_scale;
    const double majorant = std::max(largest, 1e-6 / s_.voxel);
    const bool direct_only = p_.text("components") == "direct", lobes = p_.text("phase") == "henyey_greenstein";
    stage.uniforms = {
        integer_of("samples", samples),
        // Every walk of the case has numbers of its own.
        integer_of("seed", static_cast<int>(s_.seed * 16 + std::uint32_t(light) * 3 + std::uint32_t(color))),
        integer_of("orders", static_cast<int>(p_.integer("orders"))),
        integer_of("direct", p_.text("components") != "scattered" ? 1 : 0),
        integer_of("scattered", direct_only ? 0 : 1), integer_of("channel", color), real_of("majorant", majorant),
        real_of("flight", 1 / majorant), real_of("albedo", p_.number("albedo")), integer_of("phase", lobes ? 1 : 0),
        real_of("g", lobes ? p_.number("g") : 0),
        // One environment, however many lights.
        real_of("environment", light == 0 ? p_.number("environment") : 0)};
  }

  /// The camera and what it sees, or names without content: a volume of walks is the same whoever looks. What all
  /// lights share comes with the first one.
  void add_view(LightStage& stage, int light) const {
    const ImageSetting view = s_.image();
    const double base = (1 - plan_.blend) + plan_.blend * plan_.bias, scale = plan_.blend * (1 - plan_.bias);
    const auto largest = std::max(s_.largest_tau[0], 1e-6 / s_.voxel);
    const Vector3& color = s_.light[std::size_t(light)].color;
    const Vector3 behind = light == 0 ? view.background : Vector3{0, 0, 0};
    const auto vector_of = [](const char* name, const Vector3& v) {
      return Uniform::vector(std::string("path_traced_walk_") + name, v[0], v[1], v[2]);
    };
    std::vector<Uniform> uniforms = view.rays.uniforms;
    uniforms.insert(uniforms.end(), {real_of("view_majorant", largest), real_of("view_flight", 1 / largest),
                                     real_of("base", light == 0 ? base : 0.0), real_of("first", light == 0 ? 1.0 : 0.0),
                                     vector_of("color", {scale * color[0], scale * color[1], scale * color[2]}),
                                     vector_of("background", behind)});
    std::vector<Buffer> buffers = view.rays.buffers;
    buffers.push_back(vec4_buffer("path_traced_walk_lit", view.lit));
    buffers.push_back(vec4_buffer("path_traced_walk_emitted", view.emitted));
    if (!image_) {
      for (Uniform& u : uniforms) u.f = {}, u.i = 0;
      for (Buffer& b : buffers) b = vec4_buffer(b.name, {});
    }
    stage.uniforms.insert(stage.uniforms.end(), uniforms.begin(), uniforms.end());
    stage.uniforms.push_back(Uniform::constant_integer("path_traced_walk_image", image_ ? 1 : 0));
    stage.buffers = std::move(buffers);
  }

  const ParameterSet& p_;
  const LightSetting& s_;
  bool image_ = false;
  LightPlan plan_;
};

class PathTraced : public LightPass {
 public:
  LightPlan plan(const ParameterSet& p, const LightSetting& s) const override {
    require_lights(p, s);
    if (s.surfaces)
      throw InputError(p.path() +
                       ": random walks need matter that has a length, but the optical model has surfaces, Dirac terms "
                       "or opaque values; use local_piecewise or shadow_full, or opaque \"cap\"");
    if (p.text("target") == "image") check_image(p, s);
    return Planner(p, s).plan();
  }

 private:
  static void check_image(const ParameterSet& p, const LightSetting& s) {
    const auto refuse = [&](const std::string& why) {
      throw InputError(p.path_of("target") + ": walks from the camera " + why + "; use target \"volume\"");
    };
    if (s.rgb) refuse("need extinction that is the same for all colours");
    if (s.local_shading) refuse("know no local shading: take the other pass away");
    if (s.image().glows_without_extinction)
      refuse("meet matter where it extinguishes, and do not see what glows without");
  }
};

}  // namespace

DVRLAB_PLUGIN(
    "illumination", "path_traced", "1.0", PathTraced, parameters,
    "single and multiple scattering by random walks without bias, with its standard error, as a light volume",
    "E. Woodcock et al., Techniques used in the GEM code, ANL-7050, 1965; J. Novak, A. Selle, W. Jarosz, Residual "
    "Ratio "
    "Tracking for Estimating Attenuation in Participating Media, TOG 33(6), 2014, doi:10.1145/2661229.2661292")

}  // namespace dvrlab::path_traced
