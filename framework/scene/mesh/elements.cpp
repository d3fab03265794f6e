#include "framework/scene/mesh/elements.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace dvrlab {
namespace {

using Monomials = std::array<double, element_terms>;

Monomials monomials(const Vector3& x) {
  const double r = x[0], s = x[1], t = x[2];
  return {1,     r,         s,         r * s,         t,     r * t,     s * t,     r * s * t,
          r * r, r * r * s, r * r * t, r * r * s * t, s * s, s * s * r, s * s * t, s * s * r * t,
          t * t, t * t * r, t * t * s, t * t * r * s};
}

/// By r, s and t.
std::array<Monomials, 3> monomial_derivatives(const Vector3& x) {
  const double r = x[0], s = x[1], t = x[2];
  return {Monomials{0, 1,     0, s,         0, t,     0, s * t,    2 * r, 2 * r * s, 2 * r * t, 2 * r * s * t,
                    0, s * s, 0, s * s * t, 0, t * t, 0, t * t * s},
          Monomials{0, 0,     1,     r,         0,     0,         t,         r * t,
                    0, r * r, 0,     r * r * t, 2 * s, 2 * s * r, 2 * s * t, 2 * s * r * t,
                    0, 0,     t * t, t * t * r},
          Monomials{0,     0,         0, 0, 1,     r,         s,     r * s,     0,         0,
                    r * r, r * r * s, 0, 0, s * s, s * s * r, 2 * t, 2 * t * r, 2 * t * s, 2 * t * r * s}};
}

/// The monomials that a shape uses: as many as it has nodes. (A pyramid's are no monomials; see pyramid_matrix.)
std::vector<int> terms_of(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron:
      return {0, 1, 2, 4};
    case CellShape::hexahedron:
      return {0, 1, 2, 3, 4, 5, 6, 7};
    case CellShape::wedge:
      return {0, 1, 2, 4, 5, 6};
    case CellShape::pyramid:
      break;
    case CellShape::tetrahedron10:
      return {0, 1, 2, 4, 3, 5, 6, 8, 12, 16};
    case CellShape::hexahedron20:
      return {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
    case CellShape::wedge15:
      return {0, 1, 2, 3, 8, 12, 4, 5, 6, 7, 10, 14, 16, 17, 18};
  }
  throw std::logic_error("a pyramid's shape functions are no monomials");
}

/// Nodal values -> coefficients: [term][node].
using Matrix = std::vector<std::vector<double>>;

/// The inverse of the monomials at the nodes, by elimination with pivots.
Matrix inverse_at_nodes(CellShape shape) {
  const auto terms = terms_of(shape);
  const std::size_t n = terms.size();
  Matrix a(n, std::vector<double>(2 * n, 0));
  for (std::size_t k = 0; k < n; ++k) {
    const Monomials m = monomials(reference_node(shape, static_cast<int>(k)));
    for (std::size_t j = 0; j < n; ++j) a[k][j] = m[static_cast<std::size_t>(terms[j])];
    a[k][n + k] = 1;
  }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t k = c; k < n; ++k)
      if (std::abs(a[k][c]) > std::abs(a[pivot][c])) pivot = k;
    std::swap(a[c], a[pivot]);
    for (std::size_t j = 2 * n; j-- > c;) a[c][j] /= a[c][c];
    for (std::size_t k = 0; k < n; ++k)
      if (k != c)
        for (std::size_t j = 2 * n; j-- > c;) a[k][j] -= a[k][c] * a[c][j];
  }
  Matrix m(element_terms, std::vector<double>(n, 0));
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k) m[static_cast<std::size_t>(terms[j])][k] = a[j][n + k];
  return m;
}

/// (1 - t) times the bilinear function of the base's corners, plus t times the apex.
Matrix pyramid_matrix() {
  const Matrix base = {{1, 0, 0, 0, 0}, {-1, 1, 0, 0, 0}, {-1, 0, 0, 1, 0}, {1, -1, 1, -1, 0}};
  Matrix m(element_terms, std::vector<double>(5, 0));
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t k = 0; k < 5; ++k) {
      m[j][k] = base[j][k];
      m[4 + j][k] = -base[j][k];
    }
  m[4][4] = 1;
  return m;
}

const Matrix& matrix_of(CellShape shape) {
  static const std::array<Matrix, cell_shapes> all = [] {
    std::array<Matrix, cell_shapes> list;
    for (int s = 0; s < cell_shapes; ++s) {
      const auto which = static_cast<CellShape>(s);
      list[static_cast<std::size_t>(s)] = which == CellShape::pyramid ? pyramid_matrix() : inverse_at_nodes(which);
    }
    return list;
  }();
  return all[static_cast<std::size_t>(shape)];
}

std::array<double, 4> sum_of(const Element4& e, const Monomials& m) {
  std::array<double, 4> sum{};
  for (std::size_t j = 0; j < element_terms; ++j)
    for (std::size_t c = 0; c < 4; ++c) sum[c] += e[j][c] * m[j];
  return sum;
}

bool inside(CellShape shape, const Vector3& x) {
  if (shape == CellShape::tetrahedron10) return x[0] + x[1] + x[2] <= 1 + 1e-12;
  if (shape == CellShape::wedge15) return x[0] + x[1] <= 1 + 1e-12;
  return true;
}

}  // namespace

Vector3 reference_node(CellShape shape, int node) {
  const CellShapeInfo& info = info_of(shape);
  if (node >= info.corners) {
    const auto& edge = info.edges[static_cast<std::size_t>(node - info.corners)];
    const Vector3 a = reference_node(shape, edge[0]), b = reference_node(shape, edge[1]);
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
  }
  const auto corner = static_cast<std::size_t>(node);
  constexpr std::array<Vector3, 4> tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr std::array<Vector3, 8> hexahedron{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  constexpr std::array<Vector3, 6> wedge{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
  constexpr std::array<Vector3, 5> pyramid{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (info.corners == 4) return tetrahedron[corner];
  if (info.corners == 8) return hexahedron[corner];
  return info.corners == 6 ? wedge[corner] : pyramid[corner];
}

Vector3 reference_centre(CellShape shape) {
  const int corners = info_of(shape).corners;
  Vector3 sum{};
  for (int k = 0; k < corners; ++k) {
    const Vector3 x = reference_node(shape, k);
    for (std::size_t a = 0; a < 3; ++a) sum[a] += x[a] / corners;
  }
  return sum;
}

Element4 element_of(const MeshField& mesh, std::uint64_t cell) {
  const Matrix& m = matrix_of(mesh.shape[cell]);
  const auto nodes = mesh.nodes_of(cell);
  Element4 e{};
  for (std::size_t j = 0; j < element_terms; ++j)
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double w = m[j][k];
      if (w == 0) continue;
      const Vector3& p = mesh.point[nodes[k]];
      for (std::size_t c = 0; c < 3; ++c) e[j][c] += w * p[c];
      e[j][3] += w * mesh.value[nodes[k]];
    }
  return e;
}

std::array<double, 4> evaluate(const Element4& e, const Vector3& rst) { return sum_of(e, monomials(rst)); }

std::array<std::array<double, 4>, 3> derivatives(const Element4& e, const Vector3& rst) {
  const auto d = monomial_derivatives(rst);
  return {sum_of(e, d[0]), sum_of(e, d[1]), sum_of(e, d[2])};
}

Vector3 gradient(const Element4& e, const Vector3& rst) {
  const auto d = derivatives(e, rst);  // rows: d(x, y, z, v) by r, s, t
  const auto cross = [](const std::array<double, 4>& a, const std::array<double, 4>& b) {
    return Vector3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Vector3 st = cross(d[1], d[2]), tr = cross(d[2], d[0]), rs = cross(d[0], d[1]);
  const double det = d[0][0] * st[0] + d[0][1] * st[1] + d[0][2] * st[2];
  if (det == 0) return {0, 0, 0};
  Vector3 g;
  for (std::size_t a = 0; a < 3; ++a) g[a] = (d[0][3] * st[a] + d[1][3] * tr[a] + d[2][3] * rs[a]) / det;
  return g;
}

std::pair<double, double> value_range(const MeshField& mesh) {
  const auto [a, b] = std::minmax_element(mesh.value.begin(), mesh.value.end());
  double lo = *a, hi = *b;
  constexpr int side = 9;
  for (std::uint64_t c = 0; c < mesh.cells(); ++c) {
    if (info_of(mesh.shape[c]).edges.empty()) continue;
    const Element4 e = element_of(mesh, c);
    for (int k = 0; k < side * side * side; ++k) {
      const Vector3 x{double(k % side) / (side - 1), double(k / side % side) / (side - 1),
                      double(k / side / side) / (side - 1)};
      if (!inside(mesh.shape[c], x)) continue;
      const double v = evaluate(e, x)[3];
      lo = std::min(lo, v);
      hi = std::max(hi, v);
    }
  }
  return {lo, hi};
}

double largest_bend(const MeshField& mesh) {
  double largest = 0;
  for (std::uint64_t c = 0; c < mesh.cells(); ++c) {
    const CellShapeInfo& info = info_of(mesh.shape[c]);
    const auto nodes = mesh.nodes_of(c);
    for (std::size_t k = 0; k < info.edges.size(); ++k) {
      const Vector3& a = mesh.point[nodes[static_cast<std::size_t>(info.edges[k][0])]];
      const Vector3& b = mesh.point[nodes[static_cast<std::size_t>(info.edges[k][1])]];
      const Vector3& m = mesh.point[nodes[static_cast<std::size_t>(info.corners) + k]];
      const double off = std::hypot(m[0] - 0.5 * (a[0] + b[0]), m[1] - 0.5 * (a[1] + b[1]), m[2] - 0.5 * (a[2] + b[2]));
      const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      largest = std::max(largest, length > 0 ? off / length : 0);
    }
  }
  return largest;
}

}  // namespace dvrlab
