// An estimator whose host side is right; its kernel is what the test makes of it.
#include "framework/interfaces/estimator.h"

namespace {
class Crooked : public dvrlab::EstimatorPlugin {
 public:
  dvrlab::EstimatorDeclaration declaration(const dvrlab::ParameterSet&) const override {
    dvrlab::EstimatorDeclaration d;
    d.handles = ~0u;
    return d;
  }
};
}  // namespace

DVRLAB_PLUGIN_PLAIN("estimator", "crooked", "1.0", Crooked, "For the tests of kernels that do not compile.", "")
