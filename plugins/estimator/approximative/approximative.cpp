// Approximative pre-integration from one-dimensional cumulative tables, which the framework holds (needs nothing else).
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/segment_keys.h"

namespace dvrlab::approximative {
namespace {

constexpr Parameter parameters[] = {
    mean_table_size_key,
    {"alpha_over_m", ParameterType::boolean, "", "true", "",
     "Self-attenuation of the segment's mean source by (1 - exp(-M)) / M, M its depth; false: none, as Engel et al. "
     "2001, which oversaturates.",
     Affects::pixels, "", "false"},
    shading_with_barycentre_key,
    opaque_prediction_key,
    max_extinction_key};

class Approximative : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d = declaration_of_means(p);
    d.barycentre = p.text("shading") == "barycentre";
    d.handles = Terms::every_column | Terms::rgb_bit | Terms::dirac_bit;
    return d;
  }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "approximative", "1.0", Approximative, parameters,
              "approximative pre-integration: exact depth, the mean source of the segment's values, attenuated as one",
              "F. Yang et al. 2012, equations 16-19; K. Engel, M. Kraus, T. Ertl, High-Quality Pre-Integrated Volume "
              "Rendering, Graphics Hardware 2001, doi:10.1145/383507.383515")

}  // namespace dvrlab::approximative
