// Host look-ups of a table between its entries, in fp64, for tests of what a table is good for (docs/math, B.5).
#pragma once

#include <algorithm>

#include "plugins/estimator/preintegrated/table_build.h"

namespace dvrlab::test {

enum class Interpolation { triangular, bilinear };

/// One channel between the entries. `triangular` never mixes entries from both sides of the diagonal.
inline double look_up(const preintegrated::Table& table, double v0, double v1, int output, Interpolation how) {
  const preintegrated::CellGrid& grid = table.cells().grid;
  const auto locate = [&](double v, int& i) {
    const double x = std::clamp((v - grid.v_min) / grid.width(), 0.0, double(grid.cells()));
    i = std::min(int(x), grid.cells() - 1);
    return x - i;
  };
  int i = 0, j = 0;
  const double a = locate(v0, i), b = locate(v1, j);
  const auto at = [&](int p, int q) { return double(table.at(i + p, j + q, output)); };
  if (how == Interpolation::bilinear)
    return (1 - a) * ((1 - b) * at(0, 0) + b * at(0, 1)) + a * ((1 - b) * at(1, 0) + b * at(1, 1));
  if (b >= a) return (1 - b) * at(0, 0) + (b - a) * at(0, 1) + a * at(1, 1);
  return (1 - a) * at(0, 0) + (a - b) * at(1, 0) + b * at(1, 1);
}

}  // namespace dvrlab::test
