// Entries of pre-integration tables by their definition: the composition of all cells of a segment (docs/math, B4),
// O(n^3) for a table. Independent of the builder; and the same with planted faults.
#pragma once

#include <functional>

#include "plugins/estimator/preintegrated/cells.h"
#include "plugins/estimator/preintegrated/table_request.h"

namespace dvrlab::test {

using preintegrated::Cells;
using preintegrated::SourceColumn;
using preintegrated::TableRequest;

struct Entry {
  double T = 1, C = 0, B = 0;
};

enum class Fault {
  none,
  printed_equation_22,  // Yang et al. 2012 as printed: for v1 < v0 the surface terms' int f |dv| counts negative
  off_by_one            // entry (i, j) is that of the cells one further
};

/// The entry of one source column, seen through the extinction of `extinction_channel`, from grid value i to j.
Entry defined_entry(const Cells& cells, const SourceColumn& source, int extinction_channel, double h, int i, int j,
                    Fault fault = Fault::none);

/// C of every ascending entry by Lum's slide as published (docs/math, B.5 (A)), removing the front cell: [i][j].
std::vector<std::vector<double>> literal_slide(const Cells& cells, const SourceColumn& source, int extinction_channel,
                                               double h);

/// The approximate integral C of the same cells (docs/math, B2), and the depth.
struct Approximation {
  double C, Q;
};
Approximation approximate_entry(const Cells& cells, const SourceColumn& source, int extinction_channel, double h, int i,
                                int j);

}  // namespace dvrlab::test
