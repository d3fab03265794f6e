#include "framework/scene/mesh/tetrahedra.h"

#include <algorithm>
#include <mutex>
#include <string>

#include "framework/interfaces/error.h"
#include "framework/scene/parallel.h"

namespace dvrlab {
namespace {

using Corners = std::array<std::int32_t, 4>;

constexpr std::size_t most_tetrahedra = std::size_t{1} << 29;

/// Calls add(Corners) for the tetrahedra of a cell; those of repeated nodes are left out, since nothing is in them.
template <class Add>
void cut_cell(const CellShapeInfo& shape, const std::uint32_t* node, Add add) {
  const auto at = [&](int k) { return static_cast<std::int32_t>(node[k]); };
  const auto whole = [&](const Corners& t) {
    if (t[0] != t[1] && t[0] != t[2] && t[0] != t[3] && t[1] != t[2] && t[1] != t[3] && t[2] != t[3]) add(t);
  };
  if (shape.corners == 4) return whole({at(0), at(1), at(2), at(3)});
  std::int32_t apex = at(0);
  for (int k = 1; k < shape.corners; ++k) apex = std::min(apex, at(k));
  for (const auto& face : shape.faces) {
    const int n = face[3] < 0 ? 3 : 4;
    std::int32_t around[4];
    int smallest = 0;
    bool holds_apex = false;
    for (int k = 0; k < n; ++k) {
      around[k] = at(face[static_cast<std::size_t>(k)]);
      holds_apex = holds_apex || around[k] == apex;
      if (around[k] < around[smallest]) smallest = k;
    }
    if (holds_apex) continue;
    for (int k = 1; k + 1 < n; ++k)
      whole({apex, around[smallest], around[(smallest + k) % n], around[(smallest + k + 1) % n]});
  }
}

void cut_cells(const MeshField& mesh, Tetrahedra& t) {
  const bool plain =
      std::all_of(mesh.shape.begin(), mesh.shape.end(), [](CellShape s) { return s == CellShape::tetrahedron; });
  t.vertex.reserve(mesh.cells());
  for (std::uint64_t c = 0; c < mesh.cells(); ++c) {
    cut_cell(info_of(mesh.shape[c]), mesh.node.data() + mesh.first[c], [&](const Corners& corners) {
      t.vertex.push_back(corners);
      if (!plain) t.cell.push_back(static_cast<std::uint32_t>(c));
    });
    if (t.vertex.size() > most_tetrahedra)
      throw NotSupported(mesh.source + ": more than " + std::to_string(most_tetrahedra) +
                         " tetrahedra; kernels number their corners with 31 bits");
  }
}

/// One face of one tetrahedron: its two larger vertices, and 4 * tetrahedron + the vertex opposite.
struct Side {
  std::int32_t middle, largest;
  std::uint32_t where;
};

std::array<std::int32_t, 3> sorted_face(const Corners& v, int opposite) {
  std::array<std::int32_t, 3> f;
  std::size_t n = 0;
  for (int k = 0; k < 4; ++k)
    if (k != opposite) f[n++] = v[static_cast<std::size_t>(k)];
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  if (f[1] > f[2]) std::swap(f[1], f[2]);
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  return f;
}

/// Faces sorted into buckets by their smallest vertex; equal ones are neighbours.
void join_faces(std::size_t points, Tetrahedra& t) {
  std::vector<std::uint64_t> start(points + 1, 0);
  for (const Corners& v : t.vertex)
    for (int k = 0; k < 4; ++k) ++start[static_cast<std::size_t>(sorted_face(v, k)[0]) + 1];
  for (std::size_t p = 0; p < points; ++p) start[p + 1] += start[p];
  std::vector<Side> sides(4 * t.vertex.size());
  std::vector<std::uint64_t> next(start.begin(), start.end() - 1);
  for (std::size_t j = 0; j < t.vertex.size(); ++j)
    for (int k = 0; k < 4; ++k) {
      const auto f = sorted_face(t.vertex[j], k);
      sides[next[static_cast<std::size_t>(f[0])]++] = {
          f[1], f[2], static_cast<std::uint32_t>(4 * j) + static_cast<std::uint32_t>(k)};
    }
  t.neighbour.assign(t.vertex.size(), {-1, -1, -1, -1});
  std::vector<std::uint64_t> crowded(points, 0);
  parallel_ranges(points, 4096, [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t p = begin; p < end; ++p) {
      const auto from = sides.begin() + static_cast<std::ptrdiff_t>(start[p]),
                 to = sides.begin() + static_cast<std::ptrdiff_t>(start[p + 1]);
      std::sort(from, to, [](const Side& a, const Side& b) {
        if (a.middle != b.middle) return a.middle < b.middle;
        return a.largest != b.largest ? a.largest < b.largest : a.where < b.where;
      });
      for (auto a = from; a != to;) {
        auto b = a + 1;
        while (b != to && b->middle == a->middle && b->largest == a->largest) ++b;
        if (b - a >= 2) {
          const Side &first = a[0], &second = a[1];
          t.neighbour[first.where / 4][first.where % 4] = static_cast<std::int32_t>(second.where / 4);
          t.neighbour[second.where / 4][second.where % 4] = static_cast<std::int32_t>(first.where / 4);
          if (b - a > 2) ++crowded[p];
        }
        a = b;
      }
    }
  });
  for (const std::uint64_t n : crowded) t.crowded_faces += n;
}

void list_boundary(const MeshField& mesh, Tetrahedra& t) {
  for (std::size_t j = 0; j < t.vertex.size(); ++j) {
    const Corners& v = t.vertex[j];
    for (std::size_t k = 0; k < 4; ++k) {
      if (t.neighbour[j][k] >= 0) continue;
      std::array<std::int32_t, 3> f{v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]};
      const auto at = [&](std::int32_t i) -> const Vector3& { return mesh.point[static_cast<std::size_t>(i)]; };
      if (volume6(at(f[0]), at(f[1]), at(f[2]), at(v[k])) < 0) std::swap(f[1], f[2]);
      t.boundary.push_back({f, static_cast<std::int32_t>(j)});
    }
  }
}

}  // namespace

double volume6(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  Vector3 u, v, w;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = d[k] - a[k];
  }
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

std::vector<Corners> tetrahedra_of_cell(const CellShapeInfo& shape, const std::uint32_t* node) {
  std::vector<Corners> list;
  cut_cell(shape, node, [&](const Corners& c) { list.push_back(c); });
  return list;
}

const Tetrahedra& tetrahedra_in(const MeshField& mesh) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  if (mesh.tetrahedra == nullptr) mesh.tetrahedra = std::make_shared<const Tetrahedra>(tetrahedra_of(mesh));
  return *mesh.tetrahedra;
}

Tetrahedra tetrahedra_of(const MeshField& mesh) {
  Tetrahedra t;
  cut_cells(mesh, t);
  join_faces(mesh.point.size(), t);
  list_boundary(mesh, t);
  return t;
}

}  // namespace dvrlab
