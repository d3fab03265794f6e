// The `formula` sampler: hands a formula's parameters to its kernel.
#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"

namespace {
using namespace dvrlab;

class Formula : public SamplerPlugin {
 public:
  AlongRay along_ray() const override { return AlongRay::formula; }
  KernelUnit bind(const Field& field) const override {
    const auto* formula = dynamic_cast<const FormulaField*>(&field);
    if (formula == nullptr) throw InputError("sampler formula: " + field.source + " is no formula");
    KernelUnit unit;
    unit.uniforms = formula->uniforms;
    unit.buffers = formula->buffers;
    return unit;
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("sampler", "formula", "1.0", Formula,
                    "evaluates a procedural field at every sample: no grid, value and gradient exact up to rounding",
                    "")
