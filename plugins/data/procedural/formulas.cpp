#include "plugins/data/procedural/formulas.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dvrlab::procedural {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

double sin2pi(double turns) { return std::sin(two_pi * turns); }
double cos2pi(double turns) { return std::cos(two_pi * turns); }

using Vector4 = std::array<double, 4>;

double dot(const Vector4& p, const Vector3& x) { return p[0] * x[0] + p[1] * x[1] + p[2] * x[2]; }
Vector3 scaled(const Vector4& p, double s) { return {s * p[0], s * p[1], s * p[2]}; }
double distance(const Vector4& c, const Vector3& x) { return std::hypot(x[0] - c[0], x[1] - c[1], x[2] - c[2]); }

// s (x - c) / r, and 0 in the centre, where the field has no gradient.
Vector3 outward(const Vector4& c, const Vector3& x, double s) {
  const double r = distance(c, x);
  if (r == 0) return {0, 0, 0};
  return {s * (x[0] - c[0]) / r, s * (x[1] - c[1]) / r, s * (x[2] - c[2]) / r};
}

// The node whose piece holds s: the last one at or before s, the first if there is none.
const Vector4& piece(const std::vector<Vector4>& node, double s) {
  const auto after = std::upper_bound(node.begin(), node.end(), s, [](double a, const Vector4& n) { return a < n[0]; });
  return after == node.begin() ? node.front() : *(after - 1);
}

// The benchmark's volume. It is quantised to 255 steps by definition, so that every voxel type holds the same field.
double march_table(const Vector3& x) {
  const double s = std::exp(-1.8 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2])) +
                   0.12 * std::sin(9 * x[0]) * std::sin(11 * x[1]) * std::sin(7 * x[2]) +
                   0.03 * std::sin(40 * x[0] + 23 * x[1]) * std::sin(31 * x[2]);
  return std::floor(255 * std::clamp(s, 0.0, 1.0) + 0.5) / 255;
}

Vector3 marschner_lobb_gradient(const Vector4& p, const Vector3& x) {
  constexpr double pi = std::numbers::pi;
  const double q = std::hypot(x[0], x[1]);
  const double dq = p[2] * pi * pi * p[3] * sin2pi(q / 4) * sin2pi(p[3] * cos2pi(q / 4));
  const double dz = p[1] * (pi / 2) * cos2pi(x[2] / 4);
  if (q == 0) return {0, 0, dz};
  return {dq * x[0] / q, dq * x[1] / q, dz};
}

}  // namespace

double value(const FormulaParams& f, const Vector3& x) {
  const auto& [p0, p1] = f.p;
  switch (f.kind) {
    case Kind::constant:
      return p0[0];
    case Kind::ramp:
      return p0[3] + dot(p0, x);
    case Kind::radial:
      return p0[3] + p1[0] * distance(p0, x);
    case Kind::sphere:
      return p0[3] + p1[0] * std::max(0.0, 1 - p1[1] * distance(p0, x));
    case Kind::marschner_lobb:
      return p0[0] + p0[1] * sin2pi(x[2] / 4) + p0[2] * cos2pi(p0[3] * cos2pi(std::hypot(x[0], x[1]) / 4));
    case Kind::sinusoid:
      return p1[0] + p1[1] * sin2pi(p1[2] * dot(p0, x) + p1[3]);
    case Kind::polynomial: {
      double v = p0[2];
      for (const double a : x) v += (p0[0] * a * a + p0[1]) * a * a;
      return v;
    }
    case Kind::polyline: {
      const double s = dot(p0, x);
      const Vector4& n = piece(f.node, s);
      return n[1] + n[2] * std::max(s - n[0], 0.0);
    }
    case Kind::march_table:
      return march_table(x);
  }
  throw std::logic_error("unknown formula");
}

Vector3 gradient(const FormulaParams& f, const Vector3& x) {
  const auto& [p0, p1] = f.p;
  switch (f.kind) {
    case Kind::constant:
      return {0, 0, 0};
    case Kind::ramp:
      return scaled(p0, 1);
    case Kind::radial:
      return outward(p0, x, p1[0]);
    case Kind::sphere:
      return p1[1] * distance(p0, x) < 1 ? outward(p0, x, -p1[0] * p1[1]) : Vector3{0, 0, 0};
    case Kind::marschner_lobb:
      return marschner_lobb_gradient(p0, x);
    case Kind::sinusoid:
      return scaled(p0, two_pi * p1[2] * p1[1] * cos2pi(p1[2] * dot(p0, x) + p1[3]));
    case Kind::polynomial: {
      Vector3 g;
      for (std::size_t a = 0; a < 3; ++a) g[a] = (4 * p0[0] * x[a] * x[a] + 2 * p0[1]) * x[a];
      return g;
    }
    case Kind::polyline: {
      const double s = dot(p0, x);
      return scaled(p0, s < f.node.front()[0] ? 0 : piece(f.node, s)[2]);
    }
    case Kind::march_table:
      break;
  }
  throw std::logic_error("this formula has no gradient");
}

}  // namespace dvrlab::procedural
