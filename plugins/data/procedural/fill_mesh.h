// A formula on a box that is cut into cells.
#pragma once

#include <cstdint>
#include <string>

#include "framework/interfaces/mesh.h"
#include "plugins/data/procedural/make_formula.h"

namespace dvrlab::procedural {

/// How each of the bricks between grid points is cut; the words of the key `cells` in this order.
enum class BoxCells {
  tetrahedra5,  // around a regular one; neighbours are mirrored
  tetrahedra6,  // around the diagonal from the lowest to the highest corner
  hexahedra,
  wedges,        // 2
  pyramids,      // 6, with a point in the middle
  tetrahedra10,  // 6 with nodes in the middle of their edges
  hexahedra20,
  wedges15
};

struct MeshPlan {
  std::array<int, 3> points;  // along each axis, corner to corner
  Box bounds;
  BoxCells cells;
  double jitter;  // points that do not lie on the box's surface move by up to so many spacings on each axis
  std::uint32_t seed;
};

/// Points, values (fp64) and cells; finish_mesh does the rest.
MeshField fill_mesh(const FormulaParams& f, const MeshPlan& plan);

/// Bytes that fill_mesh allocates at the most.
std::uint64_t mesh_bytes(const MeshPlan& plan);

}  // namespace dvrlab::procedural
