// The `direct` estimator: nothing to prepare, the kernel asks the medium at each segment's centre.
#include "framework/interfaces/error.h"
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/segment_keys.h"

namespace {
using namespace dvrlab;

const Parameter parameters[] = {
    {"total_variation", ParameterType::boolean, "", "false", "",
     "Surfaces between samples: |dv| is the way that the value goes between the two neighbours, not their difference, "
     "so that no surface is lost at an extremum.",
     Affects::pixels, R"({"optical_model":{"type":"hybrid","opacity":null,"surface":{"opacity":[[0.3,0],[0.8,0.6]]}}})",
     "true"},
    {"variant", ParameterType::choice, "", "\"corrected\"", "corrected|published",
     "published: the Riemann sum of Lee and Shin 2013, equations 2 to 4: the sample at the front of each segment, "
     "emission without self-attenuation.",
     Affects::pixels, "", "\"published\""},
    approximate_dirac_key};

class Direct : public EstimatorPlugin {
 public:
  void check(const ParameterSet& p) const override {
    if (p.boolean("total_variation") && p.text("variant") == "published")
      throw InputError(p.path_of("total_variation") + ": variant \"published\" has no neighbours; leave it out");
  }

  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d;
    const bool published = p.text("variant") == "published";
    d.samples = published ? EstimatorDeclaration::Samples::ends : EstimatorDeclaration::Samples::centre;
    d.front_only = published;
    d.neighbours = !published;
    d.points = 1;
    d.handles = Terms::every_column | Terms::rgb_bit;
    return d;
  }
  double dirac_pulse(const ParameterSet& p) const override { return p.number("approximate_dirac"); }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "direct", "1.1", Direct, parameters,
              "post-classification: the medium at the centre of each segment, constant over its length",
              "F. Yang et al., hybrid optical model, 2012, equations 11-15; N. Max 1995")
