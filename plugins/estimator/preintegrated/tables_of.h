// The tables of a case: which outputs they hold, and those that were built already.
#pragma once

#include <cstdint>
#include <memory>

#include "framework/interfaces/estimator.h"
#include "plugins/estimator/preintegrated/table_build.h"

namespace dvrlab::preintegrated {

/// Which group of four channels holds what; -1: none. Parts weighted with powers of the position follow their totals.
struct Groups {
  int shaded = -1;     // S.rgb and W of the first extinction channel
  int emitted = -1;    // E.rgb, with P where light does not change it; in plain tables with the first transmittance
  int particles = -1;  // P.rgb
  int highlight = -1;  // W of the second and third extinction channel: totals, back parts (or 0); C_2, then C_3
  int through = -1;    // plain tables with RGB extinction: T.rgb
};

/// What a medium's table must hold. `full`: with shading; `lit_particles`: m is not 1 everywhere; `degree`: of the
/// light factors as a polynomial of the position in a segment, 0, 1 or 3.
TableRequest request_of(const Terms& terms, bool full, bool lit_particles, bool plain, int degree, Groups& groups);

/// The table for the medium over [lo, hi] in n values: an equal one that was built before; with `partial` a copy of an
/// old one in which the entries that pass a changed cell are computed anew (they may differ from a new table's in the
/// last bit of a float); or a new one. The last table is kept, and the one before it while it is not larger than
/// most_bytes_kept. Thread-safe.
inline constexpr std::uint64_t most_bytes_kept = std::uint64_t{256} << 20;
std::shared_ptr<const Table> table_of(const Medium& medium, double lo, double hi, int n, const TableRequest& request,
                                      double h, bool partial, const BuildMeans& means);

}  // namespace dvrlab::preintegrated
