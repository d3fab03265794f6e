// Surfaces only: the scale-invariant integral in data space (Kraus 2005; Yang et al. 2012, section 3.6).
#include "framework/interfaces/surface_functions.h"

namespace dvrlab::data_space {
namespace {

constexpr Parameter parameters[] = {surface_opacity_key, surface_color_key, surface_delta_key, dv_std_key};

class DataSpace : public OpticalModelPlugin {
 public:
  void check(const ParameterSet& p) const override { SurfaceFunctions::check(p); }

  Medium medium(const ParameterSet& p, const ModelContext& context) const override {
    const SurfaceFunctions surface(p, nullptr, context);
    MediumBuilder builder(surface.curves());
    surface.add_to(builder);
    return builder.take();
  }
};

}  // namespace

DVRLAB_PLUGIN("optical_model", "data_space", "1.0", DataSpace, parameters,
              "infinitely many semitransparent isosurfaces: independent of lengths, as Kraus's integral in data space",
              "M. Kraus, Scale-Invariant Volume Rendering, IEEE Visualization 2005, doi:10.1109/VISUAL.2005.1532808; "
              "F. Yang et al. 2012, section 3.6")

}  // namespace dvrlab::data_space
