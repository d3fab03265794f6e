// Its constructor throws something that is no std::exception.
#include "framework/interfaces/estimator.h"

namespace {
class Odd : public dvrlab::EstimatorPlugin {
 public:
  Odd() { throw 42; }
  dvrlab::EstimatorDeclaration declaration(const dvrlab::ParameterSet&) const override { return {}; }
};
}  // namespace

DVRLAB_PLUGIN_PLAIN("estimator", "odd", "1.0", Odd, "For the tests of the registry.", "")
