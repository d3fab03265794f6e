// Tables as the papers print them, to show what the corrections are for (docs/math, F and B.5 (A)).
#pragma once

#include "plugins/estimator/preintegrated/table_build.h"

namespace dvrlab::preintegrated {

/// What stands in a table: the right entries; those of equation 22 of Yang et al. 2012 read as printed; those of the
/// window slide of Lum et al. 2004.
enum class Variant { corrected, published, published_slide };

/// A copy of `table`, which holds no ratios, with the entries of `variant`, over `threads` threads. The published
/// equation is integrated cell by cell, O(n^3).
std::shared_ptr<const Table> published_table(const Table& table, Variant variant, int threads);

}  // namespace dvrlab::preintegrated
