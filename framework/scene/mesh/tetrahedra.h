// A mesh as tetrahedra that share whole faces: what a walk by adjacency goes through.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "framework/interfaces/mesh.h"

namespace dvrlab {

/// Every cell cut into tetrahedra of its corners, all from its corner of the smallest index: a quadrilateral face gets
/// the diagonal of its smallest index on both sides (after Dompierre, Labbe, Vallet, Camarero 1999).
struct Tetrahedra {
  std::vector<std::array<std::int32_t, 4>> vertex;     // indices of points
  std::vector<std::array<std::int32_t, 4>> neighbour;  // tetrahedron behind the face opposite to vertex k; -1: none
  std::vector<std::uint32_t> cell;                     // that it is a part of; empty: tetrahedron j is cell j
  /// Faces with nothing behind, with their right-hand normal into the mesh, and the tetrahedron.
  struct BoundaryFace {
    std::array<std::int32_t, 3> vertex;
    std::int32_t tetrahedron;
  };
  std::vector<BoundaryFace> boundary;
  std::uint64_t crowded_faces = 0;  // shared by more than two tetrahedra: those beyond two end there
};

/// Throws NotSupported beyond 2^29 tetrahedra.
Tetrahedra tetrahedra_of(const MeshField& mesh);

/// The mesh's own, made at the first use. Thread-safe.
const Tetrahedra& tetrahedra_in(const MeshField& mesh);

/// Those of one cell, without the ones of repeated nodes, in which nothing is. `node`: the cell's, as many as it has.
std::vector<std::array<std::int32_t, 4>> tetrahedra_of_cell(const CellShapeInfo& shape, const std::uint32_t* node);

/// Six times the signed volume of four points.
double volume6(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

}  // namespace dvrlab
