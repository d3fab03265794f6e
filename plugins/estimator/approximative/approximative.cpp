// Approximative pre-integration from one-dimensional cumulative tables, which the framework holds (needs nothing else).
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/segment_keys.h"

namespace dvrlab::approximative {
namespace {

constexpr Parameter parameters[] = {
    {"table_size", ParameterType::integer, "", "4096", "[2,65536]", "Bins of the cumulative tables.", Affects::pixels,
     "", "16"},
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
    EstimatorDeclaration d;
    d.samples = EstimatorDeclaration::Samples::ends;
    d.shading = segment_shading(p);
    d.mean_bins = d.cells = static_cast<int>(p.integer("table_size"));
    d.means = 1;
    declare_prediction(p, d);
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
