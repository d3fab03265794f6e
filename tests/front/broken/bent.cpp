// A sampler whose host side is right; its kernel is what the test makes of it.
#include "framework/interfaces/field.h"

namespace {
class Bent : public dvrlab::SamplerPlugin {
 public:
  dvrlab::KernelUnit bind(const dvrlab::Field&) const override { return {}; }
};
}  // namespace

DVRLAB_PLUGIN_PLAIN("sampler", "bent", "1.0", Bent, "For the tests of kernels that do not compile.", "")
