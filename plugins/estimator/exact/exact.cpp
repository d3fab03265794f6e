// The exact integral of the canonical piecewise linear medium: the quadrature of its kernel.
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/segment_keys.h"
#include "framework/scene/buffers.h"
#include "framework/scene/gauss.h"

namespace dvrlab::exact {
namespace {

constexpr Parameter parameters[] = {
    shading_with_cubic_key,
    {"dirac_shading", ParameterType::choice, "", "\"interpolated\"", "interpolated|inside",
     "Light factors of a Dirac term inside a segment: between those of the ends, or those of its own place with the "
     "interpolated gradient.",
     Affects::pixels,
     R"({"optical_model":{"type":"hybrid","opacity":null,"surface":{"delta":[{"value":0.5,"opacity":0.6}]}},"sampling":{"step":2}})",
     "\"inside\""}};

class Exact : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d;
    d.samples = EstimatorDeclaration::Samples::ends;
    d.shading = segment_shading(p);
    d.needs_nodes = true;
    d.points = 1;
    d.handles = Terms::every_column | Terms::rgb_bit | Terms::dirac_bit;
    return d;
  }

  // Panels of optical depth (docs/math B.8). fp32: depth 1 at the most with 5 points, 5e-7, down to a depth of 20,
  // behind which 2e-9 lie; a piece of a depth of 1/8 at the most takes 3, 1.2e-7, unless its source is of degree 5.
  // fp64: depth 2 with 12 points, 6e-16, down to 42.
  void prepare(const ParameterSet& p, const EstimatorContext& context, KernelUnit& unit) const override {
    const bool fp64 = context.precision == Precision::fp64;
    const int points = fp64 ? 12 : 5;
    unit.uniforms.push_back(Uniform::constant_integer("exact_points", points));
    const bool cubic = !fp64 && p.text("shading") != "nonlinear";
    unit.uniforms.push_back(Uniform::constant_integer("exact_thin", cubic ? 1 : 0));
    unit.uniforms.push_back(Uniform::constant_integer("exact_panels", fp64 ? 21 : 20));
    unit.uniforms.push_back(Uniform::real("exact_panel_depth", fp64 ? 2.0 : 1.0));
    unit.buffers.push_back(vec4_buffer("exact_gauss", gauss_rows(points)));
  }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "exact", "1.0", Exact, parameters,
              "the exact integral over a linear scalar of the piecewise linear medium, in panels of optical depth",
              "P. Williams and N. Max, A Volume Density Optical Model, Workshop on Volume Visualization 1992, section "
              "3.3, doi:10.1145/147130.147151; docs/math B.8")

}  // namespace dvrlab::exact
