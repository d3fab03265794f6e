// One-dimensional pre-integration of Engel 2003: cumulative tables of a medium whose extinction is limited.
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/segment_keys.h"

namespace dvrlab::engel_1d {
namespace {

constexpr Parameter parameters[] = {mean_table_size_key, shading_key, opaque_prediction_key, max_extinction_key};

class Engel1d : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d = declaration_of_means(p);
    d.fixed_length = true;
    d.handles = terms_per_length;
    return d;
  }
  /// "Maximum extinction density 1": tau at most 1 / step, the colour c = source / tau is kept.
  void shape_bins(const ParameterSet&, double step, BinMedium& bins) const override {
    for (int j = 0; j < bins.count; ++j) {
      const Vector3 tau = bins.extinction(j);
      Vector3 factor;
      for (std::size_t c = 0; c < 3; ++c) factor[c] = tau[c] * step > 1 ? 1 / (tau[c] * step) : 1;
      bins.scale(j, factor);
    }
  }
  void prepare(const ParameterSet&, const EstimatorContext& context, KernelUnit& unit) const override {
    unit.uniforms.push_back(Uniform::real("engel_1d_step", context.step));
  }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "engel_1d", "1.0", Engel1d, parameters,
              "one-dimensional pre-integration with limited extinction and no self-attenuation",
              "K. Engel, Advanced Volume Rendering Techniques, IEEE Visualization 2003 tutorial; as B. Lee, Y.-G. Shin "
              "2013 describe it, doi:10.1109/TVCG.2012.313")

}  // namespace dvrlab::engel_1d
