// The keys that passes of light volumes share.
#pragma once

#include <cmath>

#include "framework/interfaces/error.h"
#include "framework/interfaces/illumination.h"
#include "framework/interfaces/light_directions.h"

namespace dvrlab {

inline constexpr Parameter light_bias_key{
    "bias",
    ParameterType::number,
    "",
    "0",
    "[0,1]",
    "I_bias, light that is always there: bias + (1 - bias) x (Hernell et al. 2008, equation 12).",
    Affects::pixels,
    "",
    "0.3"};
inline constexpr Parameter light_blend_key{
    "blend",
    ParameterType::number,
    "",
    "1",
    "[0,1]",
    "How much of the light volume acts: 1 - blend + blend x, a factor of m, k and b.",
    Affects::pixels,
    "",
    "0.5"};
inline constexpr Parameter light_storage_key{"storage",
                                             ParameterType::choice,
                                             "",
                                             "\"float32\"",
                                             "float32|unorm16",
                                             "Numbers of the finished light volume: floats, or 65536 equal steps up to "
                                             "its largest value, in half the bytes to "
                                             "read.",
                                             Affects::pixels,
                                             "",
                                             "\"unorm16\""};
inline constexpr Parameter light_opacity_scale_key{
    "light_opacity_scale",
    ParameterType::number,
    "",
    "1",
    "[0,inf)",
    "Extinction that light rays see, relative to the medium's (opacity correction for light rays).",
    Affects::pixels,
    "",
    "0.5"};
inline constexpr Parameter light_resolution_key{"resolution",
                                                ParameterType::integer,
                                                "",
                                                "128",
                                                "[2,2048]",
                                                "Points of the light volume along the longest side of data that have "
                                                "no grid of their own; a voxel is its spacing there.",
                                                Affects::pixels,
                                                R"({"data":{"evaluate":"formula"}})",
                                                "24"};
inline constexpr Parameter light_radius_key{"radius",
                                            ParameterType::number,
                                            "voxel",
                                            "16",
                                            "(0,inf)",
                                            "Radius of the sphere that light is gathered from.",
                                            Affects::pixels,
                                            "",
                                            "5"};
inline constexpr Parameter light_samples_key{
    "samples", ParameterType::integer, "", "8", "[1,1024]", "Samples along each direction.", Affects::pixels, "", "3"};
inline constexpr Parameter light_solid_key{"solid",
                                           ParameterType::choice,
                                           "",
                                           "\"octahedron\"",
                                           "tetrahedron|octahedron|icosahedron",
                                           "Directions are the centres of its faces: 4, 8 or 20.",
                                           Affects::pixels,
                                           "",
                                           "\"icosahedron\""};
inline constexpr Parameter light_subdivisions_key{
    "subdivisions",
    ParameterType::integer,
    "",
    "1",
    "[0,3]",
    "How often each face is cut into four: 32 directions are the octahedron once.",
    Affects::pixels,
    "",
    "0"};
inline constexpr Parameter light_weights_key{
    "weights",
    ParameterType::choice,
    "",
    "\"equal\"",
    "equal|solid_angle",
    "Weights of the directions: all alike, or the solid angles of their faces.",
    Affects::pixels,
    "",
    "\"solid_angle\""};

inline std::vector<LightDirection> light_directions(const ParameterSet& p, const Vector3& toward) {
  return light_directions(static_cast<Solid>(p.choice_index("solid")), static_cast<int>(p.integer("subdivisions")),
                          p.text("weights") == "solid_angle", toward);
}

/// A pass that fills a light volume, with the keys above.
class LightPass : public IlluminationPlugin {
 public:
  bool fills_light_volume() const override { return true; }
  int resolution(const ParameterSet& p) const override { return static_cast<int>(p.integer("resolution")); }
};

/// A plan without stages, with what the keys above say.
inline LightPlan light_plan(const ParameterSet& p) {
  LightPlan plan;
  plan.opacity_scale = p.number("light_opacity_scale");
  plan.bias = p.number("bias");
  plan.blend = p.number("blend");
  plan.storage = static_cast<LightStorage>(p.choice_index("storage"));
  return plan;
}

/// Software GPUs end all loops of an invocation once they have made 65535 rounds together, without a word. A stage
/// whose voxels may come near that says so (LightStage::long_loops).
inline constexpr double most_rounds = 16384;

/// Throws InputError where a pass has no light.
inline void require_lights(const ParameterSet& p, const LightSetting& setting) {
  if (setting.light.empty())
    throw InputError(p.path() + ": the pass spreads light, but the case has no lights; add one to lights");
}

/// Unit direction from the box centre towards a light; a point at the centre itself lies above it.
inline Vector3 towards(const Light& light) {
  const Vector3& x = light.position;
  const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  if (!(length > 0)) return {0, 0, 1};
  return {x[0] / length, x[1] / length, x[2] / length};
}

}  // namespace dvrlab
