// The medium averaged over the bins of a regular grid of values: what one-dimensional tables are made of, and what an
// estimator may reshape before they are made.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "framework/interfaces/parameter_set.h"

namespace dvrlab {

/// Bin j of 1 .. count - 2 covers [lo + (j - 1) w, lo + j w], w = (hi - lo) / (count - 2), in stored values; bins 0 and
/// count - 1 are what lies below and above, with the medium's values at lo and hi.
struct BinMedium {
  int count = 0;   // bins, the two outer ones included; 0: there are none
  int groups = 0;  // groups of four numbers per bin, those of framework/kernel/medium.kernel
  double lo = 0, hi = 1;
  std::array<int, 3> extinction_at{};  // where tau_l of each channel stands in a bin's numbers
  std::unique_ptr<double[]> mean;      // [bin][group][4], per world length or per stored value

  double* bin(int j) { return mean.get() + 4 * static_cast<std::ptrdiff_t>(j) * groups; }
  const double* bin(int j) const { return mean.get() + 4 * static_cast<std::ptrdiff_t>(j) * groups; }
  /// tau_l of bin j per channel, 1 / world length.
  Vector3 extinction(int j) const {
    const double* b = bin(j);
    return {b[extinction_at[0]], b[extinction_at[1]], b[extinction_at[2]]};
  }
  /// Multiplies everything in bin j, extinction and sources, by a factor per channel; for media without surface terms.
  void scale(int j, const Vector3& factor) {
    double* b = bin(j);
    // Grey extinction has one factor for all channels: then it does not matter which of the four is the extinction.
    for (int g = 0; g < groups; ++g)
      for (std::size_t k = 0; k < 4; ++k) b[4 * g + static_cast<int>(k)] *= factor[k % 3];
  }
};

}  // namespace dvrlab
