// Runge-Kutta integration of equation 3 of Williams and Max 1992; nothing to prepare.
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/segment_keys.h"

namespace dvrlab::rk4 {
namespace {

constexpr Parameter parameters[] = {
    {"steps", ParameterType::integer, "", "4", "[1,256]",
     "Steps of each segment. Each must have a depth below 2.78, or the method is unstable.", Affects::pixels, "", "1"},
    shading_with_cubic_key,
    opaque_prediction_key,
    max_extinction_key,
    approximate_dirac_key};

class Rk4 : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d;
    d.samples = EstimatorDeclaration::Samples::ends;
    d.shading = segment_shading(p);
    d.points = 1 + 2 * static_cast<int>(p.integer("steps"));
    declare_prediction(p, d);
    d.handles = Terms::every_column | Terms::rgb_bit;
    return d;
  }
  double dirac_pulse(const ParameterSet& p) const override { return p.number("approximate_dirac"); }
};

}  // namespace

DVRLAB_PLUGIN(
    "estimator", "rk4", "1.0", Rk4, parameters,
    "the differential equation of radiance by the classic Runge-Kutta method of the fourth order",
    "P. Williams and N. Max, A Volume Density Optical Model, Workshop on Volume Visualization 1992, equation 3, "
    "doi:10.1145/147130.147151")

}  // namespace dvrlab::rk4
