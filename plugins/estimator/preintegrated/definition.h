// Entries of pre-integration tables as they are defined: the composition of all cells of a segment (docs/math, B4), one
// entry after the other and independent of the builder, which tests hold against them; and what the papers print.
#pragma once

#include "plugins/estimator/preintegrated/cells.h"
#include "plugins/estimator/preintegrated/table_request.h"

namespace dvrlab::preintegrated {

/// Transmittance, radiance and the radiance's parts weighted with the position in the segment, its square and its cube
/// (C_1 to C_3; the published slide has only the first), without dimension.
struct Entry {
  double T = 1, C = 0, B = 0, second = 0, third = 0;
};

/// The entry of one source column, seen through the extinction of `extinction_channel`, from grid value i to j, for
/// segments of length h: O(|j - i|). `surface_sign` -1 counts the integrals over |dv| negative, as equation 22 of Yang
/// et al. 2012 does for v1 < v0 where it is read as printed.
Entry defined_entry(const Cells& cells, const SourceColumn& source, int extinction_channel, double h, int i, int j,
                    double surface_sign = 1);

/// Radiance of the approximate integral of the same cells (docs/math, B2), by which ratio tables divide, and their
/// depth.
struct Approximation {
  double C, Q;
};
Approximation approximate_entry(const Cells& cells, const SourceColumn& source, int extinction_channel, double h, int i,
                                int j);

/// All entries of m > 0 cells by the slide that Lum et al. 2004 publish (docs/math, B.5 (A)), in the order of their
/// front values along the direction of travel. It removes the front cell by a division by its transmittance, which
/// amplifies rounding without bound: results may be anything, NaN too.
std::vector<Entry> published_slide(const Cells& cells, const SourceColumn& source, int extinction_channel, double h,
                                   int m, bool descending);

}  // namespace dvrlab::preintegrated
