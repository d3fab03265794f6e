// The medium at both ends of a segment, averaged in one of four ways; nothing to prepare.
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/segment_keys.h"

namespace dvrlab::average {
namespace {

constexpr Parameter parameters[] = {
    {"rule", ParameterType::choice, "", "\"trapezoid\"", "trapezoid|exact_depth|mean_density|linear_opacity",
     "trapezoid: depth and source are averaged; the others average the chromaticity, with the exact depth (Williams "
     "and "
     "Max, equation 5), the mean density (equation 6), or the depth itself as the opacity (equation 8).",
     Affects::pixels, "", "\"mean_density\""},
    {"table_size", ParameterType::integer, "", "4096", "[2,65536]",
     "Bins of the cumulative tables: of the exact depth (rule exact_depth), and of the barycentre (shading "
     "barycentre).",
     Affects::pixels, R"({"estimator":{"rule":"exact_depth"}})", "16"},
    shading_with_barycentre_key,
    opaque_prediction_key,
    max_extinction_key,
    approximate_dirac_key};

class Average : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d;
    d.samples = EstimatorDeclaration::Samples::ends;
    d.shading = segment_shading(p);
    d.barycentre = p.text("shading") == "barycentre";
    if (p.text("rule") == "exact_depth" || d.barycentre)
      d.mean_bins = d.cells = static_cast<int>(p.integer("table_size"));
    declare_prediction(p, d);
    d.points = 2;
    d.means = p.text("rule") == "exact_depth" ? 1 : 0;
    d.handles = Terms::every_column | Terms::rgb_bit;
    d.chromaticity = p.text("rule") != "trapezoid";
    return d;
  }
  double dirac_pulse(const ParameterSet& p) const override { return p.number("approximate_dirac"); }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "average", "1.0", Average, parameters,
              "the mean of the medium at both ends of each segment: the trapezoid and the averages of Williams and Max",
              "P. Williams and N. Max, A Volume Density Optical Model, Workshop on Volume Visualization 1992, "
              "doi:10.1145/147130.147151")

}  // namespace dvrlab::average
