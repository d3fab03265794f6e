// How often each value occurs in a grid.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/interfaces/field.h"

namespace dvrlab {

/// Bins of physical values, ascending. A grid of integers has one bin per integer, so that everything is exact; floats
/// are rounded to the nearest of 65536 values between the smallest and the largest.
struct Histogram {
  double first = 0, step = 0;  // physical value of bin 0; from one bin to the next, >= 0
  bool exact = true;
  std::vector<std::uint64_t> count;
  std::uint64_t total = 0;

  double value(std::size_t bin) const { return first + static_cast<double>(bin) * step; }
  double last() const { return value(count.size() - 1); }
  /// The smallest value that at least the share q of all voxels does not exceed; q in [0, 1].
  double quantile(double q) const;
  /// Voxels with a value of at least `value`.
  std::uint64_t at_least(double value) const;
  /// At most `bins` bins of equal width (the last may be narrower), each the sum of neighbours.
  Histogram merged(std::size_t bins) const;
};

/// Reads all voxels once. Memory: 512 KiB per thread.
Histogram histogram_of(const GridField& grid);

}  // namespace dvrlab
