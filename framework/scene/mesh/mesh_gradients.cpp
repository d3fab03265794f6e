#include "framework/scene/mesh/mesh_gradients.h"

#include <cmath>

#include "framework/scene/mesh/elements.h"
#include "framework/scene/parallel.h"

namespace dvrlab {
namespace {

/// Of a 4-node tetrahedron, without the detour over polynomials.
Vector3 linear_gradient(const MeshField& mesh, const std::uint32_t* n) {
  std::array<Vector3, 3> e;
  std::array<double, 3> dv;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t a = 0; a < 3; ++a) e[k][a] = mesh.point[n[k + 1]][a] - mesh.point[n[0]][a];
    dv[k] = mesh.value[n[k + 1]] - mesh.value[n[0]];
  }
  const auto cross = [](const Vector3& a, const Vector3& b) {
    return Vector3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Vector3 c0 = cross(e[1], e[2]), c1 = cross(e[2], e[0]), c2 = cross(e[0], e[1]);
  const double det = e[0][0] * c0[0] + e[0][1] * c0[1] + e[0][2] * c0[2];
  if (det == 0) return {0, 0, 0};
  Vector3 g;
  for (std::size_t a = 0; a < 3; ++a) g[a] = (dv[0] * c0[a] + dv[1] * c1[a] + dv[2] * c2[a]) / det;
  return g;
}

}  // namespace

std::vector<Vector3> cell_gradients(const MeshField& mesh) {
  std::vector<Vector3> g(mesh.cells());
  parallel_ranges(mesh.cells(), 4096, [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t c = begin; c < end; ++c)
      g[c] = mesh.shape[c] == CellShape::tetrahedron ? linear_gradient(mesh, mesh.nodes_of(c).data())
                                                     : gradient(element_of(mesh, c), reference_centre(mesh.shape[c]));
  });
  return g;
}

std::vector<Vector3> vertex_gradients(const MeshField& mesh, bool inverse_distance) {
  const std::vector<Vector3> of_cell = cell_gradients(mesh);
  std::vector<Vector3> sum(mesh.point.size(), Vector3{0, 0, 0});
  std::vector<double> weight(mesh.point.size(), 0);
  for (std::uint64_t c = 0; c < mesh.cells(); ++c) {
    const auto nodes = mesh.nodes_of(c).first(static_cast<std::size_t>(info_of(mesh.shape[c]).corners));
    Vector3 centre{};
    for (const std::uint32_t n : nodes)
      for (std::size_t a = 0; a < 3; ++a) centre[a] += mesh.point[n][a] / static_cast<double>(nodes.size());
    for (const std::uint32_t n : nodes) {
      const Vector3& p = mesh.point[n];
      const double distance = std::hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]);
      const double w = inverse_distance && distance > 0 ? 1 / distance : 1;
      for (std::size_t a = 0; a < 3; ++a) sum[n][a] += w * of_cell[c][a];
      weight[n] += w;
    }
  }
  for (std::size_t p = 0; p < sum.size(); ++p)
    if (weight[p] > 0)
      for (double& x : sum[p]) x /= weight[p];
  return sum;
}

}  // namespace dvrlab
