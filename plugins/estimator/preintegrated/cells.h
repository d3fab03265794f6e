// The cells of a pre-integration table: exact integrals of a medium between neighbouring grid values
// (docs/math, section B.5).
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "framework/interfaces/medium.h"

namespace dvrlab::preintegrated {

/// n values g_i = v_min + i d, i = 0 .. n-1, with n-1 cells between them.
struct CellGrid {
  int n = 0;
  double v_min = 0, v_max = 1;
  int cells() const { return n - 1; }
  double width() const { return (v_max - v_min) / (n - 1); }
  double value(int i) const { return i == n - 1 ? v_max : v_min + i * width(); }
  bool operator==(const CellGrid&) const = default;
};

/// A Dirac term inside a cell: cell k owns those of (g_k, g_{k+1}], so that a crossing at a grid value is neither lost
/// nor counted twice. u in (0, 1] is the position from the cell's low end; mu is an optical depth, c a colour.
struct CellDirac {
  int cell;
  double u;
  Vector3 mu, c;
  bool operator==(const CellDirac&) const = default;
};

struct Cells {
  CellGrid grid;
  /// Indexed by column(term, channel), one entry per cell: of tau_l, E, P, S_l, W_l the mean over the cell
  /// (1/length), of tau_s, S_s, W_s the integral over the cell (dimensionless, or intensity). Without Diracs.
  std::array<std::vector<double>, medium_columns> integral;
  /// The length terms' values at the n grid values (right limit at a jump): the diagonal of a table.
  std::array<std::vector<double>, medium_columns> at_value;
  /// Ascending.
  std::vector<CellDirac> dirac;
};

/// Exact to rounding: every column is a quadratic polynomial between the medium's nodes. Throws InputError when the
/// grid has fewer than 2 values or no width, or when a depth is infinite: opaque intervals and opaque isosurfaces end
/// a segment before it is looked up, they cannot be summed.
Cells integrate_cells(const Medium& medium, const CellGrid& grid);

/// The least range [first, last) of cells outside which `a` and `b` (of one grid) agree in everything that a table is
/// made of; nothing when they agree everywhere. A grid value belongs to both cells beside it.
std::optional<std::pair<int, int>> changed_cells(const Cells& a, const Cells& b);

}  // namespace dvrlab::preintegrated
