#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plugins/data/procedural/formulas.h"

namespace dvrlab::procedural {
namespace {

using Range = std::array<double, 2>;

// a + b * r
Range affine(double a, double b, const Range& r) {
  const auto [lo, hi] = std::minmax({a + b * r[0], a + b * r[1]});
  return {lo, hi};
}

Range dot_range(const std::array<double, 4>& p, const Vector3& lo, const Vector3& hi) {
  Range r{0, 0};
  for (std::size_t a = 0; a < 3; ++a) {
    r[0] += std::min(p[a] * lo[a], p[a] * hi[a]);
    r[1] += std::max(p[a] * lo[a], p[a] * hi[a]);
  }
  return r;
}

Range distance_range(const std::array<double, 4>& c, const Vector3& lo, const Vector3& hi) {
  Vector3 nearest, farthest;
  for (std::size_t a = 0; a < 3; ++a) {
    nearest[a] = std::clamp(c[a], lo[a], hi[a]) - c[a];
    farthest[a] = std::max(std::fabs(lo[a] - c[a]), std::fabs(hi[a] - c[a]));
  }
  return {std::hypot(nearest[0], nearest[1], nearest[2]), std::hypot(farthest[0], farthest[1], farthest[2])};
}

// Of sin2pi over [a, b] turns: the ends, and the crests and troughs between them.
Range sine_range(const Range& turns) {
  const auto sine = [](double t) { return std::sin(2 * std::numbers::pi * t); };
  const auto holds = [&](double phase) { return std::floor(turns[1] - phase) >= std::ceil(turns[0] - phase); };
  const auto [lo, hi] = std::minmax({sine(turns[0]), sine(turns[1])});
  return {holds(0.75) ? -1 : lo, holds(0.25) ? 1 : hi};
}

// Of c4 q^2 + c2 q with q = x^2: the ends, q = 0 where x changes sign, and the vertex.
Range quartic_range(double c4, double c2, double lo, double hi) {
  const auto f = [=](double q) { return c4 * q * q + c2 * q; };
  const auto [q0, q1] = std::minmax({lo * lo, hi * hi});
  const double least = lo <= 0 && hi >= 0 ? 0 : q0;
  const double vertex = c4 == 0 ? least : std::clamp(-c2 / (2 * c4), least, q1);
  return {std::min({f(least), f(vertex), f(q1)}), std::max({f(least), f(vertex), f(q1)})};
}

Range polyline_range(const FormulaParams& f, const Range& s) {
  const auto at = [&](double x) {
    FormulaParams along = f;
    along.p[0] = {1, 0, 0, 0};
    return value(along, {x, 0, 0});
  };
  const auto [lo, hi] = std::minmax({at(s[0]), at(s[1])});
  Range r{lo, hi};
  for (const auto& n : f.node) {
    if (n[0] < s[0] || n[0] > s[1]) continue;
    r = {std::min(r[0], n[1]), std::max(r[1], n[1])};
  }
  return r;
}

}  // namespace

Range range(const FormulaParams& f, const Vector3& lo, const Vector3& hi) {
  const auto& [p0, p1] = f.p;
  switch (f.kind) {
    case Kind::constant:
      return {p0[0], p0[0]};
    case Kind::ramp:
      return affine(p0[3], 1, dot_range(p0, lo, hi));
    case Kind::radial:
      return affine(p0[3], p1[0], distance_range(p0, lo, hi));
    case Kind::sphere: {
      const Range r = distance_range(p0, lo, hi);
      return affine(p0[3], p1[0], {std::max(0.0, 1 - p1[1] * r[1]), std::max(0.0, 1 - p1[1] * r[0])});
    }
    case Kind::marschner_lobb: {
      const Range z = affine(p0[0], p0[1], sine_range({lo[2] / 4, hi[2] / 4}));
      return {z[0] - std::fabs(p0[2]), z[1] + std::fabs(p0[2])};
    }
    case Kind::sinusoid:
      return affine(p1[0], p1[1], sine_range(affine(p1[3], p1[2], dot_range(p0, lo, hi))));
    case Kind::polynomial: {
      Range sum{p0[2], p0[2]};
      for (std::size_t a = 0; a < 3; ++a) {
        const Range r = quartic_range(p0[0], p0[1], lo[a], hi[a]);
        sum = {sum[0] + r[0], sum[1] + r[1]};
      }
      return sum;
    }
    case Kind::polyline:
      return polyline_range(f, dot_range(p0, lo, hi));
    case Kind::march_table:
      return {0, 1};
  }
  throw std::logic_error("unknown formula");
}

}  // namespace dvrlab::procedural
