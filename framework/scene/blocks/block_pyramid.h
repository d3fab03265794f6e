// A grid at the blocks' levels of detail.
#pragma once

#include <array>
#include <vector>

#include "framework/interfaces/blocks.h"

namespace dvrlab {

/// interblock: level l has every 2^l-th grid point, so that noise, and with it what transfer functions make of it on
/// average, stays what it is. clamp: the mean of 2^l voxels along each axis. Beyond the last grid point its value goes
/// on.
class BlockPyramid {
 public:
  BlockPyramid(const GridField& grid, const BlockChoice& choice);
  /// The sample of a level at (x, y, z), counted over the whole grid. Level 0: the stored value.
  float at(int level, int x, int y, int z) const;
  static std::uint64_t bytes(const std::array<int, 3>& dims, const BlockChoice& choice);

 private:
  float voxel(int x, int y, int z) const;
  void fill(int level);

  const GridField& grid_;
  BlockChoice choice_;
  std::array<std::array<int, 3>, BlockedField::most_levels> dims_{};
  std::array<std::vector<float>, BlockedField::most_levels> values_;  // of level 0: nothing
};

}  // namespace dvrlab
