// What there is to say of a mesh.
#pragma once

#include <array>
#include <cstdint>

#include "framework/interfaces/mesh.h"

namespace dvrlab {

struct MeshSummary {
  std::array<std::uint64_t, cell_shapes> cells{};
  std::uint64_t points = 0, tetrahedra = 0;
  std::uint64_t boundary_faces = 0;  // triangles
  std::uint64_t crowded_faces = 0;   // shared by more than two cells
  std::uint64_t pieces = 0;          // that no face joins
  double volume = 0;                 // world units
  /// Mean ratio of the cells' tetrahedra, 12 (3 V)^(2/3) / (sum of the squared edges): 1 for a regular one, 0 for a
  /// flat one (Liu and Joe 1994). Of a hexahedron's six, a cube has 0.74 to 0.78.
  double least_quality = 1, median_quality = 1;
  std::uint64_t poor = 0;  // tetrahedra with less than 0.1
  double bend = 0;         // largest_bend
};

MeshSummary summary_of(const MeshField& mesh);

}  // namespace dvrlab
