// The `my_estimator` estimator: the mean of the medium at both ends of a segment, constant over its length.
#include "framework/interfaces/estimator.h"

namespace dvrlab::my_estimator {
namespace {

// A number becomes the kernel's uniform my_estimator_front.
const Parameter parameters[] = {
    {"front", ParameterType::number, "", "0.5", "[0,1]", "Weight of the segment's front end.", Affects::pixels, "",
     "0.1"},
};

class MyEstimator : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration(const ParameterSet&) const override {
    EstimatorDeclaration d;
    d.samples = EstimatorDeclaration::Samples::ends;
    // What the kernel integrates. A medium with another term (surfaces, Diracs) is refused at validation.
    for (Term t : {Term::tau_l, Term::E, Term::P, Term::S_l, Term::W_l}) d.handles |= Terms::bit(t);
    d.handles |= Terms::rgb_bit;
    return d;
  }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "my_estimator", "0.1", MyEstimator, parameters,
              "the medium's mean over both ends of each segment, constant over its length", "")

}  // namespace dvrlab::my_estimator
