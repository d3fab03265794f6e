// The straightforward scalar build of a pre-integration table, for comparison (bench/README.md).
#pragma once

#include <vector>

#include "plugins/estimator/preintegrated/cells.h"

namespace dvrlab::bench {

/// Entries (C of E + P in red, green and blue; T) of both directions in the order of table_layout.h.
struct ScalarTable {
  std::vector<float> entry[2];
};

/// Incremental subrange integration in its contractive form (docs/math, B5), one thread, the library's exp; grey
/// extinction, no Diracs, no surface sources. `table` keeps its memory from call to call.
void build_scalar(const preintegrated::Cells& cells, double h, ScalarTable& table);

}  // namespace dvrlab::bench
