#include "plugins/data/procedural/fill_mesh.h"

#include <algorithm>
#include <unordered_map>

#include "plugins/data/procedural/formulas.h"

namespace dvrlab::procedural {
namespace {

/// Uniform in [0, 1) from whole numbers (PCG's output function).
double hashed(std::uint32_t a, std::uint32_t b) {
  std::uint32_t x = a * 747796405u + b * 2891336453u + 12345u;
  for (int k = 0; k < 2; ++k) {
    x = x * 747796405u + 2891336453u;
    x = ((x >> ((x >> 28) + 4)) ^ x) * 277803737u;
    x = (x >> 22) ^ x;
  }
  return x / 4294967296.0;
}

/// Adds cells of the corners of bricks; middle nodes of edges are made once for all cells at an edge.
class Filler {
 public:
  Filler(const FormulaParams& f, const MeshPlan& plan) : f_(f), plan_(plan) {}

  MeshField take() {
    add_points();
    for (int k = 0; k + 1 < plan_.points[2]; ++k)
      for (int j = 0; j + 1 < plan_.points[1]; ++j)
        for (int i = 0; i + 1 < plan_.points[0]; ++i) add_brick(i, j, k);
    return std::move(mesh_);
  }

 private:
  using Ids = std::array<std::uint32_t, 8>;

  std::uint32_t add_point(const Vector3& x) {
    mesh_.point.push_back(x);
    mesh_.value.push_back(value(f_, x));
    return static_cast<std::uint32_t>(mesh_.point.size() - 1);
  }
  void add_points() {
    const auto& n = plan_.points;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          const std::array<int, 3> at{i, j, k};
          const bool on_surface = i == 0 || j == 0 || k == 0 || i + 1 == n[0] || j + 1 == n[1] || k + 1 == n[2];
          Vector3 x;
          for (std::size_t a = 0; a < 3; ++a) {
            const double spacing = (plan_.bounds.hi[a] - plan_.bounds.lo[a]) / (n[a] - 1);
            x[a] = at[a] + 1 == n[a] ? plan_.bounds.hi[a] : plan_.bounds.lo[a] + at[a] * spacing;
            if (!on_surface)
              x[a] += spacing * plan_.jitter *
                      (2 * hashed(static_cast<std::uint32_t>(3 * mesh_.point.size() + a), plan_.seed) - 1);
          }
          add_point(x);
        }
  }
  std::uint32_t grid_point(int i, int j, int k) const {
    return static_cast<std::uint32_t>((k * plan_.points[1] + j) * plan_.points[0] + i);
  }
  /// In the middle between two points; the value is the formula's there.
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
    const auto found = middles_.find(key);
    if (found != middles_.end()) return found->second;
    Vector3 x;
    for (std::size_t c = 0; c < 3; ++c) x[c] = 0.5 * (mesh_.point[a][c] + mesh_.point[b][c]);
    return middles_[key] = add_point(x);
  }
  void add(CellShape shape, std::initializer_list<std::uint32_t> corners) {
    std::vector<std::uint32_t> nodes(corners);
    for (const auto& edge : info_of(shape).edges)
      nodes.push_back(middle(nodes[static_cast<std::size_t>(edge[0])], nodes[static_cast<std::size_t>(edge[1])]));
    mesh_.add_cell(shape, nodes);
  }
  void add_brick(int i, int j, int k) {
    // VTK's order: around the lower face, then above it.
    const Ids p{grid_point(i, j, k),
                grid_point(i + 1, j, k),
                grid_point(i + 1, j + 1, k),
                grid_point(i, j + 1, k),
                grid_point(i, j, k + 1),
                grid_point(i + 1, j, k + 1),
                grid_point(i + 1, j + 1, k + 1),
                grid_point(i, j + 1, k + 1)};
    using enum CellShape;
    switch (plan_.cells) {
      case BoxCells::tetrahedra5:
        return add_five(p, (i + j + k) % 2 == 1);
      case BoxCells::tetrahedra6:
        return add_six(p, tetrahedron);
      case BoxCells::tetrahedra10:
        return add_six(p, tetrahedron10);
      case BoxCells::hexahedra:
        return add(hexahedron, {p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]});
      case BoxCells::hexahedra20:
        return add(hexahedron20, {p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]});
      case BoxCells::wedges:
        return add_wedges(p, wedge);
      case BoxCells::wedges15:
        return add_wedges(p, wedge15);
      case BoxCells::pyramids:
        return add_pyramids(p);
    }
  }
  void add_five(const Ids& p, bool mirrored) {
    using enum CellShape;
    if (mirrored) {
      add(tetrahedron, {p[0], p[1], p[2], p[5]});
      add(tetrahedron, {p[0], p[2], p[3], p[7]});
      add(tetrahedron, {p[0], p[5], p[7], p[4]});
      add(tetrahedron, {p[2], p[7], p[5], p[6]});
      add(tetrahedron, {p[0], p[2], p[7], p[5]});
    } else {
      add(tetrahedron, {p[0], p[1], p[3], p[4]});
      add(tetrahedron, {p[1], p[2], p[3], p[6]});
      add(tetrahedron, {p[1], p[6], p[4], p[5]});
      add(tetrahedron, {p[3], p[4], p[6], p[7]});
      add(tetrahedron, {p[1], p[3], p[4], p[6]});
    }
  }
  /// The six ways along edges from corner 0 to corner 6.
  void add_six(const Ids& p, CellShape shape) {
    constexpr std::array<std::array<std::size_t, 2>, 6> ways{{{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}};
    for (const auto& w : ways) add(shape, {p[0], p[w[0]], p[w[1]], p[6]});
  }
  void add_wedges(const Ids& p, CellShape shape) {
    add(shape, {p[0], p[2], p[1], p[4], p[6], p[5]});
    add(shape, {p[0], p[3], p[2], p[4], p[7], p[6]});
  }
  void add_pyramids(const Ids& p) {
    Vector3 x{};
    for (const std::uint32_t n : p)
      for (std::size_t a = 0; a < 3; ++a) x[a] += mesh_.point[n][a] / 8;
    const std::uint32_t apex = add_point(x);
    for (const auto& f : info_of(CellShape::hexahedron).faces)
      add(CellShape::pyramid, {p[static_cast<std::size_t>(f[3])], p[static_cast<std::size_t>(f[2])],
                               p[static_cast<std::size_t>(f[1])], p[static_cast<std::size_t>(f[0])], apex});
  }

  const FormulaParams& f_;
  const MeshPlan& plan_;
  MeshField mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

}  // namespace

MeshField fill_mesh(const FormulaParams& f, const MeshPlan& plan) { return Filler(f, plan).take(); }

std::uint64_t mesh_bytes(const MeshPlan& plan) {
  std::uint64_t points = 1, bricks = 1;
  for (const int n : plan.points) {
    points *= static_cast<std::uint64_t>(n);
    bricks *= static_cast<std::uint64_t>(n - 1);
  }
  struct Share {
    std::uint64_t cells, nodes, points;  // per brick; points beside the corners
  };
  constexpr Share shares[] = {{5, 20, 0}, {6, 24, 0}, {1, 8, 0},  {2, 12, 0},
                              {6, 30, 1}, {6, 60, 8}, {1, 20, 4}, {2, 30, 6}};
  const Share s = shares[static_cast<std::size_t>(plan.cells)];
  // Points: place, value, an entry of the map. Vectors grow by doubling.
  return 2 * (points * 32 + bricks * (s.points * 64 + s.cells * 9 + s.nodes * 4));
}

}  // namespace dvrlab::procedural
