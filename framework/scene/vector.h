// fp64 vectors of the host side.
#pragma once

#include <cmath>
#include <string>

#include "framework/interfaces/error.h"
#include "framework/interfaces/parameter_set.h"

namespace dvrlab {

inline Vector3 plus(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector3 minus(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector3 times(const Vector3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector3& a) { return std::sqrt(dot(a, a)); }

/// a / |a|; throws InputError with `what` (a key's path and what it should be) when a is 0.
inline Vector3 unit_vector(const Vector3& a, const std::string& what) {
  const double l = length(a);
  if (!(l > 1e-300)) throw InputError(what);
  return times(a, 1.0 / l);
}

}  // namespace dvrlab
