#include "framework/scene/mesh/mesh_summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "framework/scene/mesh/elements.h"
#include "framework/scene/mesh/tetrahedra.h"

namespace dvrlab {
namespace {

double quality_of(const std::array<Vector3, 4>& p, double volume) {
  double edges = 0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b)
      for (std::size_t c = 0; c < 3; ++c) edges += (p[a][c] - p[b][c]) * (p[a][c] - p[b][c]);
  return edges > 0 ? 12 * std::cbrt(9 * volume * volume) / edges : 0;
}

/// Sets that neighbours join.
std::uint64_t pieces_of(const Tetrahedra& t) {
  std::vector<std::int32_t> parent(t.vertex.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      auto& up = parent[static_cast<std::size_t>(i)];
      up = parent[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  };
  for (std::size_t j = 0; j < t.vertex.size(); ++j)
    for (const std::int32_t n : t.neighbour[j])
      if (n >= 0) parent[static_cast<std::size_t>(root(static_cast<std::int32_t>(j)))] = root(n);
  std::uint64_t count = 0;
  for (std::size_t j = 0; j < parent.size(); ++j) count += parent[j] == static_cast<std::int32_t>(j) ? 1 : 0;
  return count;
}

}  // namespace

MeshSummary summary_of(const MeshField& mesh) {
  const Tetrahedra& t = tetrahedra_in(mesh);
  MeshSummary s;
  for (const CellShape shape : mesh.shape) ++s.cells[static_cast<std::size_t>(shape)];
  s.points = mesh.point.size();
  s.tetrahedra = t.vertex.size();
  s.boundary_faces = t.boundary.size();
  s.crowded_faces = t.crowded_faces;
  s.pieces = pieces_of(t);
  std::vector<double> quality;
  quality.reserve(t.vertex.size());
  for (const auto& v : t.vertex) {
    std::array<Vector3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.point[static_cast<std::size_t>(v[k])];
    const double volume = std::abs(volume6(p[0], p[1], p[2], p[3])) / 6;
    s.volume += volume;
    quality.push_back(quality_of(p, volume));
    s.poor += quality.back() < 0.1 ? 1 : 0;
  }
  const auto middle = quality.begin() + static_cast<std::ptrdiff_t>(quality.size() / 2);
  std::nth_element(quality.begin(), middle, quality.end());
  s.median_quality = *middle;
  s.least_quality = *std::min_element(quality.begin(), quality.end());
  s.bend = largest_bend(mesh);
  return s;
}

}  // namespace dvrlab
