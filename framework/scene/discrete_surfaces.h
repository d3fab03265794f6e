// The medium's discrete surfaces as the kernels read them (framework/kernel/discrete.kernel has the layout).
#pragma once

#include "framework/interfaces/kernel_unit.h"
#include "framework/interfaces/medium.h"

namespace dvrlab {

/// Adds the uniforms medium_diracs, medium_opaques and the buffer medium_discrete. `fold_shaded`: opaque
/// colours are P + S (an unlit medium: k = 1, b = 0).
void add_discrete_surfaces(const Medium& medium, bool fold_shaded, KernelUnit& unit);

/// The medium with every Dirac term replaced by a triangular pulse of tau_s of the same depth and colour, `width` wide
/// in its own values: for estimators that cannot cross a discrete isosurface. Throws InputError for a width <= 0.
Medium with_pulses(const Medium& medium, double width);

}  // namespace dvrlab
