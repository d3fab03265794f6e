// One-dimensional pre-integration of Kye et al. 2008: cumulative tables of opacities.
#include <cmath>

#include "framework/interfaces/estimator.h"
#include "framework/interfaces/segment_keys.h"

namespace dvrlab::kye_1d {
namespace {

constexpr Parameter parameters[] = {mean_table_size_key, shading_key, opaque_prediction_key, max_extinction_key};

class Kye1d : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d = declaration_of_means(p);
    d.fixed_length = true;
    d.handles = terms_per_length;
    return d;
  }
  /// The opacity 1 - exp(-step tau) of every bin in place of its depth step tau, and the colour with it.
  void shape_bins(const ParameterSet&, double step, BinMedium& bins) const override {
    for (int j = 0; j < bins.count; ++j) {
      const Vector3 tau = bins.extinction(j);
      Vector3 factor;
      for (std::size_t c = 0; c < 3; ++c) factor[c] = tau[c] > 0 ? -std::expm1(-tau[c] * step) / (tau[c] * step) : 1;
      bins.scale(j, factor);
    }
  }
  void prepare(const ParameterSet&, const EstimatorContext& context, KernelUnit& unit) const override {
    unit.uniforms.push_back(Uniform::real("kye_1d_step", context.step));
    unit.uniforms.push_back(Uniform::real("kye_1d_inv_step", 1 / context.step));
  }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "kye_1d", "1.0", Kye1d, parameters,
              "one-dimensional pre-integration by the arithmetic mean of opacities (PI_1D of Lee and Shin 2013)",
              "H. Kye, B. Shin, Y.-G. Shin, Interactive Classification for Pre-Integrated Volume Rendering of "
              "High-Precision Volume Data, Graphical Models 70, 2008")

}  // namespace dvrlab::kye_1d
