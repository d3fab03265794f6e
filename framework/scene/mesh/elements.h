// Cells whose value is no linear function of the place: geometry and value as polynomials of reference coordinates.
#pragma once

#include <array>
#include <utility>

#include "framework/interfaces/mesh.h"

namespace dvrlab {

/// Monomials of every shape's shape functions: those of degree 1 in each coordinate, then r^2, s^2, t^2 times the
/// bilinear ones of the other two coordinates. In the order in which kernels sum them
/// (plugins/sampler/mesh/mesh.kernel):
///   1 r s rs t rt st rst | r^2 (1 s t st) | s^2 (1 r t rt) | t^2 (1 r s rs)
inline constexpr int element_terms = 20, linear_element_terms = 8;

/// (x, y, z, value) per monomial.
using Element4 = std::array<std::array<double, 4>, element_terms>;

/// World coordinates, physical value.
Element4 element_of(const MeshField& mesh, std::uint64_t cell);

/// Place and value at reference coordinates; cells are 0 <= r, s, t <= 1, tetrahedra r + s + t <= 1, wedges r + s <= 1.
std::array<double, 4> evaluate(const Element4& e, const Vector3& rst);
/// Their derivatives by r, s, t.
std::array<std::array<double, 4>, 3> derivatives(const Element4& e, const Vector3& rst);
/// The gradient of the value in the world; 0 where the cell has no volume there.
Vector3 gradient(const Element4& e, const Vector3& rst);

/// Reference coordinates of a node, and of the mean of the corners.
Vector3 reference_node(CellShape shape, int node);
Vector3 reference_centre(CellShape shape);

/// Least and greatest value inside the cells: quadratic ones can leave the range of their nodes. Sought on a lattice of
/// 9 x 9 x 9 points of each.
std::pair<double, double> value_range(const MeshField& mesh);

/// How far the middle nodes of edges lie from the edges' middles, relative to the edges, at the most: 0 where every
/// cell is as its corners say.
double largest_bend(const MeshField& mesh);

}  // namespace dvrlab
