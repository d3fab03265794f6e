// Local ambient occlusion (Hernell, Ljung, Ynnerman 2007): light from a sphere around every voxel, without any light
// source.
#include "framework/interfaces/light_keys.h"
#include "framework/scene/buffers.h"

namespace dvrlab::local_ambient_occlusion {
namespace {

const Parameter parameters[] = {
    light_radius_key,        light_samples_key, light_solid_key, light_subdivisions_key, light_weights_key,
    light_opacity_scale_key, light_bias_key,    light_blend_key, light_storage_key,      light_resolution_key,
};

class LocalAmbientOcclusion : public LightPass {
 public:
  LightPlan plan(const ParameterSet& p, const LightSetting& s) const override {
    LightPlan plan = light_plan(p);
    std::vector<double> table;
    for (const LightDirection& d : light_directions(p, {0, 0, 1})) {
      const Vector3 toward = s.sampler_direction(d.omega);
      table.insert(table.end(),
                   {toward[0], toward[1], toward[2], d.weight / static_cast<double>(p.integer("samples"))});
    }
    const auto samples = static_cast<int>(p.integer("samples"));
    LightStage stage;
    stage.kernel = "local_ambient_occlusion_sphere";
    stage.label = "sphere";
    stage.grid = s.points(s.rgb ? 3 : 1);
    stage.uniforms = {Uniform::integer("local_ambient_occlusion_sphere_directions", static_cast<int>(table.size() / 4)),
                      Uniform::integer("local_ambient_occlusion_sphere_samples", samples),
                      Uniform::real("local_ambient_occlusion_sphere_part", p.number("radius") * s.voxel / samples)};
    stage.long_loops = static_cast<double>(table.size()) / 4 * samples > most_rounds;
    stage.buffers = {vec4_buffer("local_ambient_occlusion_sphere_direction", table)};
    plan.stages.push_back(std::move(stage));
    plan.parts.push_back({{0}, -1});
    return plan;
  }
};

}  // namespace

DVRLAB_PLUGIN(
    "illumination", "local_ambient_occlusion", "1.0", LocalAmbientOcclusion, parameters,
    "light from a sphere around every voxel, dimmed by what lies in it, as a light volume",
    "F. Hernell, P. Ljung, A. Ynnerman, Efficient Ambient and Emissive Tissue Illumination using Local Occlusion in "
    "Multiresolution Volume Rendering, Volume Graphics 2007, doi:10.2312/VG/VG07/001-008")

}  // namespace dvrlab::local_ambient_occlusion
