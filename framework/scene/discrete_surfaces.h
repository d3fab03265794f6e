// The medium's discrete surfaces as the kernels read them (framework/kernel/discrete.kernel has the layout).
#pragma once

#include <vector>

#include "framework/interfaces/estimator.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

/// The ranges ascending and apart: of overlapping ones the first holds, and an isosurface that lies on a range is part
/// of it.
std::vector<OpaqueRange> disjoint(const std::vector<OpaqueRange>& ranges);

/// Adds the uniforms medium_diracs, medium_opaques, medium_prediction, the buffer medium_discrete and the prediction
/// table medium_opaque_next over the bins of the medium's table. With `options.fold_shaded` opaque colours are P + S
/// (an unlit medium: k = 1, b = 0).
void add_discrete_surfaces(const Medium& medium, const MediumTableOptions& options, OpaquePrediction prediction,
                           KernelUnit& unit);

/// The medium with its columns continued from outside into opaque ranges, to their middle. No segment enters a range,
/// but a table's cell may lie across its end: there it must hold what is in front.
Medium continued_into_opaque(const Medium& medium);

/// The medium without opaque values: `extinction` (per world length) stands for an infinite one in opaque ranges, a
/// Dirac term of depth 16.6 for an opaque isosurface.
Medium without_opaque_values(const Medium& medium, double extinction);

/// The medium with every Dirac term replaced by a triangular pulse of tau_s of the same depth and colour, `width` wide
/// in its own values: for estimators that cannot cross a discrete isosurface. Throws InputError for a width <= 0.
Medium with_pulses(const Medium& medium, double width);

}  // namespace dvrlab
