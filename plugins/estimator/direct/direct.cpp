// The `direct` estimator: nothing to prepare, the kernel asks the medium at each segment's centre.
#include "framework/interfaces/estimator.h"

namespace {
using namespace dvrlab;

class Direct : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration() const override {
    EstimatorDeclaration d;
    d.samples = EstimatorDeclaration::Samples::centre;
    for (Term t : {Term::tau_l, Term::E, Term::P, Term::S_l, Term::W_l}) d.handles |= Terms::bit(t);
    d.handles |= Terms::rgb_bit;
    return d;
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("estimator", "direct", "1.0", Direct,
                    "post-classification: the medium at the centre of each segment, constant over its length",
                    "F. Yang et al., hybrid optical model, 2012, equations 11-15; N. Max 1995")
