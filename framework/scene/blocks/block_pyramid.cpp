#include "framework/scene/blocks/block_pyramid.h"

#include <algorithm>

#include "framework/scene/parallel.h"

namespace dvrlab {
namespace {

template <class T>
float stored(const GridField& grid, std::size_t index) {
  return static_cast<float>(static_cast<const T*>(grid.voxels.get())[index]);
}

std::size_t place(const std::array<int, 3>& n, int x, int y, int z) {
  return (std::size_t(z) * std::size_t(n[1]) + std::size_t(y)) * std::size_t(n[0]) + std::size_t(x);
}

}  // namespace

BlockPyramid::BlockPyramid(const GridField& grid, const BlockChoice& choice) : grid_(grid), choice_(choice) {
  if (choice.border == BlockBorder::interblock) return;
  const int levels = levels_of(choice.side);
  for (int l = 0; l < levels; ++l)
    for (std::size_t a = 0; a < 3; ++a)
      dims_[std::size_t(l)][a] = ((grid.dims[a] - 1) / choice.side + 1) * (choice.side >> l);
  for (int l = 1; l < levels; ++l) fill(l);
}

float BlockPyramid::voxel(int x, int y, int z) const {
  const auto& n = grid_.dims;
  const std::size_t i = place(n, std::min(x, n[0] - 1), std::min(y, n[1] - 1), std::min(z, n[2] - 1));
  switch (grid_.type) {
    case VoxelType::u8:
      return stored<std::uint8_t>(grid_, i);
    case VoxelType::i8:
      return stored<std::int8_t>(grid_, i);
    case VoxelType::u16:
      return stored<std::uint16_t>(grid_, i);
    case VoxelType::i16:
      return stored<std::int16_t>(grid_, i);
    case VoxelType::f32:
      return stored<float>(grid_, i);
  }
  return 0;
}

float BlockPyramid::at(int level, int x, int y, int z) const {
  if (choice_.border == BlockBorder::interblock) return voxel(x << level, y << level, z << level);
  if (level == 0) return voxel(x, y, z);
  return values_[std::size_t(level)][place(dims_[std::size_t(level)], x, y, z)];
}

void BlockPyramid::fill(int level) {
  const auto& n = dims_[std::size_t(level)];
  std::vector<float>& out = values_[std::size_t(level)];
  out.resize(place(n, 0, 0, n[2]));
  parallel_ranges(std::uint64_t(n[2]), 1, [&](std::uint64_t begin, std::uint64_t end) {
    for (int z = int(begin); z < int(end); ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x) {
          float sum = 0;
          for (int k = 0; k < 8; ++k) sum += at(level - 1, 2 * x + (k & 1), 2 * y + (k >> 1 & 1), 2 * z + (k >> 2));
          out[place(n, x, y, z)] = 0.125f * sum;
        }
  });
}

std::uint64_t BlockPyramid::bytes(const std::array<int, 3>& dims, const BlockChoice& choice) {
  if (choice.border == BlockBorder::interblock) return 0;
  std::uint64_t numbers = 0;
  for (int l = 1; l < levels_of(choice.side); ++l) {
    std::uint64_t points = 1;
    for (const int n : dims) points *= std::uint64_t(((n - 1) / choice.side + 1) * (choice.side >> l));
    numbers += points;
  }
  return numbers * sizeof(float);
}

}  // namespace dvrlab
