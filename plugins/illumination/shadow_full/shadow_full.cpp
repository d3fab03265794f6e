// Direct light with every voxel's whole way to the light integrated at full resolution: what local_piecewise
// approximates.
#include "framework/interfaces/light_keys.h"

namespace dvrlab::shadow_full {
namespace {

const Parameter parameters[] = {
    {"step", ParameterType::number, "voxel", "1", "(0,inf)", "Distance of the samples on the way to the light.",
     Affects::pixels, "", "4"},
    light_opacity_scale_key,
    light_bias_key,
    light_blend_key,
    light_storage_key,
    light_resolution_key,
};

class ShadowFull : public LightPass {
 public:
  LightPlan plan(const ParameterSet& p, const LightSetting& s) const override {
    require_lights(p, s);
    LightPlan plan = light_plan(p);
    for (int first = 0; first < static_cast<int>(s.light.size()); first += s.lights_per_volume()) {
      LightStage stage;
      stage.kernel = "shadow_full_march";
      stage.label = "march";
      stage.grid = s.points(s.channels_from(first));
      stage.first_light = first;
      stage.long_loops = s.box_diagonal / (p.number("step") * s.voxel) * stage.grid.channels > most_rounds;
      stage.uniforms = {Uniform::real("shadow_full_march_step", p.number("step") * s.voxel),
                        Uniform::real("shadow_full_march_inv_step", 1 / (p.number("step") * s.voxel))};
      plan.parts.push_back({{static_cast<int>(plan.stages.size())}, first});
      plan.stages.push_back(std::move(stage));
    }
    return plan;
  }
};

}  // namespace

DVRLAB_PLUGIN(
    "illumination", "shadow_full", "1.0", ShadowFull, parameters,
    "direct light, every voxel's way to the light integrated at full resolution, as a light volume",
    "F. Hernell, P. Ljung, A. Ynnerman, Interactive Global Light Propagation in Direct Volume Rendering using Local "
    "Piecewise Integration, 2008, figure 6a, doi:10.2312/VG/VG-PBG08/105-112")

}  // namespace dvrlab::shadow_full
