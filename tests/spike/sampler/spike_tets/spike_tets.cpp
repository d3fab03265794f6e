// Test-only sampler that settles the contract of walking samplers (docs/adr/0001): the test makes the buffers.
#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"

namespace {
using namespace dvrlab;

class SpikeTets : public SamplerPlugin {
 public:
  KernelUnit bind(const Field& field) const override {
    const auto* mesh = dynamic_cast<const FormulaField*>(&field);
    if (mesh == nullptr) throw InputError("sampler spike_tets: " + field.source + " brings no tetrahedra");
    KernelUnit unit;
    unit.uniforms = mesh->uniforms;
    unit.buffers = mesh->buffers;
    return unit;
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("sampler", "spike_tets", "1.0", SpikeTets, "test only: a walk through a few tetrahedra", "")
