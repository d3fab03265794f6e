// The formulas of the procedural fields: one layout of parameters, read by the host evaluation below (fp64, the
// truth of tests) and by the kernel of the formula sampler (uniforms formula_p0, formula_p1; buffer formula_nodes).
#pragma once

#include <array>
#include <vector>

#include "framework/interfaces/parameter_set.h"

namespace dvrlab::procedural {

/// The values are those of the constant uniform `formula_kind`. Layouts are written p0 = (x, y, z, w). A `direction`
/// is normalised. Angles are in turns, for sin2pi; cos2pi(u) = sin2pi(u + 1/4). c = centre, r = |x - c|.
enum class Kind : int {
  // v = p0.x
  //   gradient 0
  constant = 0,
  // p0 = (scale * direction, offset):  v = p0.w + dot(p0.xyz, x)
  //   gradient p0.xyz
  ramp = 1,
  // p0 = (c, offset), p1 = (scale, -, -, -):  v = p0.w + p1.x r
  //   gradient p1.x (x-c)/r, 0 at r = 0
  radial = 2,
  // p0 = (c, offset), p1 = (scale, 1/radius, -, -):  v = p0.w + p1.x max(0, 1 - p1.y r)
  //   gradient -p1.x p1.y (x-c)/r for p1.y r < 1, else 0; 0 at r = 0
  sphere = 3,
  // p0 = (A, B, C, f_m), with n = scale/(2(1+alpha)): A = offset + n(1+alpha), B = -n, C = n alpha;
  // q = sqrt(x^2+y^2), u = cos2pi(q/4):  v = A + B sin2pi(z/4) + C cos2pi(f_m u)
  //   dv/dz = B (pi/2) cos2pi(z/4)
  //   dv/dq = C pi^2 f_m sin2pi(q/4) sin2pi(f_m u), times (x, y)/q; 0 at q = 0
  marschner_lobb = 4,
  // p0 = (direction, -), p1 = (a, b, omega/2pi, phi/2pi), s = dot(p0.xyz, x):
  // v = p1.x + p1.y sin2pi(p1.z s + p1.w)
  //   gradient 2pi p1.z p1.y cos2pi(p1.z s + p1.w) p0.xyz
  sinusoid = 5,
  // the quartic "tangle"; p0 = (c4, c2, c0, -), c4 = 25/27 scale, c2 = -20/27 scale, c0 = offset + 12/27 scale:
  // v = c0 + sum over x,y,z of (c4 q^2 + c2 q), q = x^2
  //   gradient component (4 c4 q + 2 c2) x
  polynomial = 6,
  // p0 = (direction, -), s = dot(p0.xyz, x), nodes k = 0 .. formula_count-1 of formula_nodes as
  // (position, value, slope to the next node, 0), positions strictly ascending, slope 0 in the last:
  // k = the last node with position <= s (the first if none):  v = value_k + slope_k max(s - position_k, 0)
  //   gradient slope_k p0.xyz, 0 for s < position_0; at a node the right one
  polyline = 7,
  // p unused, on a grid only (see formulas.cpp): the volume of the march benchmark
  march_table = 8
};

/// Everything that a formula reads. p[0], p[1] and `node` have the layout that stands at the kind. The uniform
/// `formula_count` is the number of nodes; other kinds have one node of zeros, so that the buffer always exists.
struct FormulaParams {
  Kind kind = Kind::constant;
  std::array<std::array<double, 4>, 2> p{};
  std::vector<std::array<double, 4>> node{{0, 0, 0, 0}};
};

/// The field at x (world units), fp64.
double value(const FormulaParams& f, const Vector3& x);

/// The exact gradient at x, per world unit; where the field has a kink, the value that stands at the kind.
/// march_table has none: throws std::logic_error.
Vector3 gradient(const FormulaParams& f, const Vector3& x);

/// Bounds of value() over the box [lo, hi]: {minimum, maximum}. Exact but for radial, sphere, ramp, polynomial and
/// polyline up to fp64 rounding; marschner_lobb, sinusoid and march_table may be wider, never narrower.
std::array<double, 2> range(const FormulaParams& f, const Vector3& lo, const Vector3& hi);

}  // namespace dvrlab::procedural
