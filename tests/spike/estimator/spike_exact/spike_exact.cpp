// Test-only estimator that settles the contract of segments integrated between their ends (docs/adr/0001).
#include "framework/interfaces/estimator.h"

namespace {
using namespace dvrlab;
using enum ParameterType;

const Parameter parameters[] = {
    {"dirac_light", choice, "", "\"ends\"", "ends|inside",
     "Light of the Dirac term: interpolated between the segment's ends, or the shading hole at its own place.",
     Affects::pixels, "", "\"inside\""},
    {"dirac_value", number, "stored value", "0.5", "", "Value of the Dirac term.", Affects::pixels, "", "0.6"},
    {"dirac_depth", vector3, "", "[0,0,0]", "[0,inf)", "Optical depth of the Dirac term; 0: none.", Affects::pixels, "",
     "[1,1,1]"},
    {"dirac_color", vector3, "", "[1,1,1]", "[0,inf)", "Colour of the Dirac term.", Affects::pixels, "", "[1,0,0]"},
};

class SpikeExact : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration(const ParameterSet&) const override {
    EstimatorDeclaration d;
    d.samples = EstimatorDeclaration::Samples::ends;
    d.needs_nodes = true;
    for (Term t : {Term::tau_l, Term::E, Term::P, Term::S_l, Term::W_l}) d.handles |= Terms::bit(t);
    d.handles |= Terms::rgb_bit;
    return d;
  }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "spike_exact", "1.0", SpikeExact, parameters,
              "test only: exact segment of a piecewise linear medium with one Dirac term", "")
