// Data on an unstructured mesh, as the mesh readers deliver it and the mesh sampler reads it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/interfaces/field.h"

namespace dvrlab {

/// Shapes of cells. Nodes are in VTK's order: corners first, then the middles of edges.
enum class CellShape : std::uint8_t { tetrahedron, hexahedron, wedge, pyramid, tetrahedron10, hexahedron20, wedge15 };
inline constexpr int cell_shapes = 7;

struct CellShapeInfo {
  const char* name;  // "10-node tetrahedron"
  int vtk_type;      // of VTK's files
  int nodes, corners;
  /// Corners of each face, in order around it; -1 behind those of a triangle.
  std::span<const std::array<std::int8_t, 4>> faces;
  /// The corners between which node `corners + k` lies.
  std::span<const std::array<std::int8_t, 2>> edges;
  bool linear() const { return nodes == 4; }  // in world coordinates, so that its gradient is constant
};
const CellShapeInfo& info_of(CellShape shape);

/// What finish_mesh found and mended.
struct MeshFaults {
  std::uint64_t duplicate_cells = 0;  // the same nodes as an earlier cell: dropped
  std::uint64_t collapsed_cells = 0;  // no volume left, since nodes coincide: dropped
  std::uint64_t flat_cells = 0;       // a corner tetrahedron without volume: kept
  std::uint64_t inverted_cells = 0;   // negative volume: walked and evaluated as they are
  std::uint64_t merged_points = 0;    // equal place and value as an earlier one
  std::uint64_t unused_points = 0;    // of no cell: dropped
};

struct Tetrahedra;  // framework/scene/mesh/tetrahedra.h

/// What normals follow: the gradient of each cell; or gradients at the corners, the mean of those at the centres of the
/// cells around, linear between; the mean may weigh a cell with the inverse of its centre's distance (Williams and Max
/// 1992, section 3.2).
enum class MeshGradient { cell, vertex, vertex_inverse_distance };

/// A scalar at the nodes of a mesh. Sampler coordinates: the box of the nodes, centred, half its diagonal is 1.
struct MeshField : Field {
  std::vector<Vector3> point;        // world coordinates
  std::vector<double> value;         // physical, one per point
  std::vector<CellShape> shape;      // one per cell
  std::vector<std::uint64_t> first;  // where a cell's nodes begin in `node`; one more than cells
  std::vector<std::uint32_t> node;   // indices of points
  MeshFaults faults;
  MeshGradient gradient = MeshGradient::vertex_inverse_distance;
  double longest = 0;       // distance of two corners of a cell: no ray is longer in one
  double tolerance = 1e-3;  // of values in cells that are not linear, as a part of the field's range
  mutable std::shared_ptr<const Tetrahedra> tetrahedra;  // made at the first use
  mutable std::shared_ptr<const KernelUnit> resampled;   // likewise: on a grid, for light volumes
  mutable std::array<int, 3> resampled_dims{};
  std::uint64_t cells() const { return shape.size(); }
  std::span<const std::uint32_t> nodes_of(std::uint64_t cell) const {
    return {node.data() + first[cell], node.data() + first[cell + 1]};
  }
  std::uint64_t bytes() const;
  /// A cell of `nodes` (as many as its shape has).
  void add_cell(CellShape s, std::span<const std::uint32_t> nodes);
};

/// Completes a mesh whose points, values, cells and source are set: checks it, mends what MeshFaults lists (said aloud
/// in its notes), and sets sampler, to_world, lo, hi, voxel (the mean length of an edge), slope, intercept, stored_min
/// and stored_max (stored values are 0 to 1). Applies the nan policy to values ("error", or "replace").
/// Throws InputError: no cells, an index beyond the points, a coordinate or (policy "error") a value that is not
/// finite.
void finish_mesh(MeshField& mesh, const std::string& nan_policy, double nan_value);

/// Cell values to points: the mean over the cells of a point. `values`: one per cell.
std::vector<double> points_of_cells(const MeshField& mesh, std::span<const double> values);

}  // namespace dvrlab
