// Empty-space skipping: the value range of every 8^3 cells, and from it the distance to the nearest occupied one.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "framework/interfaces/field.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

/// Closed range of the stored values that any sample inside a macrocell can take: the minimum and maximum of the 9^3
/// grid points of its cells (trilinear interpolation stays between them).
struct Macrocells {
  std::array<int, 3> dims;
  std::vector<float> lo, hi;
};

/// Independent of the transfer function: made once per field and kept by it.
std::shared_ptr<const Macrocells> macrocells_of(const GridField& grid);

/// Bytes that macrocells_of and empty_distance allocate for a grid.
std::uint64_t skipping_bytes(const std::array<int, 3>& dims);

/// Chebyshev distance in macrocells to the nearest one that is not empty: 0 there, at most 255.
std::vector<std::uint8_t> empty_distance(const Macrocells& cells, const OccupiedBins& bins);

}  // namespace dvrlab
