// Its constructor throws.
#include <stdexcept>

#include "framework/interfaces/estimator.h"

namespace {
class Grumpy : public dvrlab::EstimatorPlugin {
 public:
  Grumpy() { throw std::runtime_error("not in the mood"); }
  dvrlab::EstimatorDeclaration declaration(const dvrlab::ParameterSet&) const override { return {}; }
};
}  // namespace

DVRLAB_PLUGIN_PLAIN("estimator", "grumpy", "1.0", Grumpy, "For the tests of the registry.", "")
