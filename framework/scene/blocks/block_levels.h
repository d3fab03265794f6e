// Which level of detail each block gets.
#pragma once

#include <array>
#include <vector>

#include "framework/interfaces/blocks.h"
#include "framework/scene/blocks/block_colors.h"
#include "framework/scene/blocks/block_pyramid.h"

namespace dvrlab {

/// A block as the choice sees it.
struct BlockErrors {
  /// Sum over its voxels of BlockColors::square per level; [dropped]: if it is, infinite where it may not be.
  std::array<double, BlockedField::dropped + 1> square{};
  int visible = 0;       // of its voxels
  float lo = 0, hi = 0;  // values any of which may stand for it when it is dropped
};

/// Samples that a block of a level takes: whole eights; dropped, none.
int block_samples(const BlockChoice& choice, int level);

std::vector<BlockErrors> block_errors(const GridField& grid, const BlockPyramid& pyramid, const BlockChoice& choice,
                                      const BlockColors& colors, const ArrangeInput& input);

/// A level per block, or BlockedField::dropped: empty ones, and those with little to be seen. With a wanted reduction:
/// those with the smallest sum of squares that fit, by Lagrange's multiplier, and what is left over goes where it gains
/// most. `kept_back`: samples that are needed for something else.
std::vector<int> choose_levels(const std::vector<BlockErrors>& blocks, const BlockChoice& choice,
                               std::uint64_t grid_points, std::uint64_t kept_back);

}  // namespace dvrlab
