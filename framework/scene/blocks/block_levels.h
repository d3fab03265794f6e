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
  std::array<double, BlockedField::levels> square{};  // sum over its voxels of BlockColors::square, per level
  int visible = 0;  // of its voxels
  float lo = 0, hi = 0;  // of its stored values, with those on the faces that it shares
  bool empty = false;
};

/// Samples that a block of a level takes: whole eights.
int block_samples(BlockBorder border, int level);

std::vector<BlockErrors> block_errors(const GridField& grid, const BlockPyramid& pyramid, BlockBorder border,
                                      const BlockColors& colors, const ArrangeInput& input);

/// A level per block, BlockedField::dropped for empty ones. With a wanted reduction: those with the smallest sum of
/// squares that fit, by Lagrange's multiplier, and what is left over goes where it gains most.
std::vector<int> choose_levels(const std::vector<BlockErrors>& blocks, const BlockChoice& choice,
                               std::uint64_t grid_points);

}  // namespace dvrlab
