// Nothing is wrong with this one but where it lies.
#include "framework/interfaces/estimator.h"

namespace {
class Twin : public dvrlab::EstimatorPlugin {
 public:
  dvrlab::EstimatorDeclaration declaration(const dvrlab::ParameterSet&) const override { return {}; }
};
}  // namespace

DVRLAB_PLUGIN_PLAIN("estimator", "twin", "1.0", Twin, "For the tests of the registry.", "")
