// From the resolved parameters to the layout of formulas.h.
#pragma once

#include <string>

#include "framework/interfaces/parameter_set.h"
#include "plugins/data/procedural/formulas.h"

namespace dvrlab::procedural {

struct Box {
  Vector3 lo, hi;
};

/// Throws InputError naming the key (a direction of length 0, nodes that do not ascend).
FormulaParams make_formula(const ParameterSet& parameters);

/// `bounds`: [[x, y, z], [x, y, z]], lower corner first. Throws InputError naming the key.
Box read_bounds(const ParameterSet& parameters);

/// `range`: [lo, hi] with lo < hi, or the fallback when it is null. Throws InputError naming the key.
std::array<double, 2> read_range(const ParameterSet& parameters, const std::array<double, 2>& fallback);

}  // namespace dvrlab::procedural
