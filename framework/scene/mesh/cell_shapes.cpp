#include "framework/interfaces/mesh.h"

namespace dvrlab {
namespace {

using Face = std::array<std::int8_t, 4>;
using Edge = std::array<std::int8_t, 2>;

constexpr Face tetrahedron_faces[] = {{1, 2, 3, -1}, {0, 3, 2, -1}, {0, 1, 3, -1}, {0, 2, 1, -1}};
constexpr Face hexahedron_faces[] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                     {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
constexpr Face wedge_faces[] = {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
constexpr Face pyramid_faces[] = {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};

constexpr Edge tetrahedron_edges[] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
constexpr Edge hexahedron_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                     {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr Edge wedge_edges[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};

constexpr CellShapeInfo shapes[cell_shapes] = {
    {"tetrahedron", 10, 4, 4, tetrahedron_faces, {}},
    {"hexahedron", 12, 8, 8, hexahedron_faces, {}},
    {"wedge", 13, 6, 6, wedge_faces, {}},
    {"pyramid", 14, 5, 5, pyramid_faces, {}},
    {"10-node tetrahedron", 24, 10, 4, tetrahedron_faces, tetrahedron_edges},
    {"20-node hexahedron", 25, 20, 8, hexahedron_faces, hexahedron_edges},
    {"15-node wedge", 26, 15, 6, wedge_faces, wedge_edges},
};

}  // namespace

const CellShapeInfo& info_of(CellShape shape) { return shapes[static_cast<std::size_t>(shape)]; }

std::uint64_t MeshField::bytes() const {
  return point.size() * (sizeof(Vector3) + sizeof(double)) +
         shape.size() * (sizeof(CellShape) + sizeof(std::uint64_t)) + node.size() * sizeof(std::uint32_t);
}

void MeshField::add_cell(CellShape s, std::span<const std::uint32_t> nodes) {
  if (first.empty()) first.push_back(0);
  shape.push_back(s);
  node.insert(node.end(), nodes.begin(), nodes.end());
  first.push_back(node.size());
}

}  // namespace dvrlab
