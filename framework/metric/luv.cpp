#include "framework/metric/luv.h"

#include <algorithm>
#include <cmath>

namespace dvrlab {
namespace {

using Triple = std::array<double, 3>;

double decoded(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

Triple xyz_of(const Triple& c) {
  return {0.4124564 * c[0] + 0.3575761 * c[1] + 0.1804375 * c[2],
          0.2126729 * c[0] + 0.7151522 * c[1] + 0.0721750 * c[2],
          0.0193339 * c[0] + 0.1191920 * c[1] + 0.9503041 * c[2]};
}

/// u', v'.
std::array<double, 2> chromaticity(const Triple& xyz) {
  const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
  return {4 * xyz[0] / sum, 9 * xyz[1] / sum};
}

}  // namespace

std::array<double, 3> luv_of(const std::array<double, 3>& rgb, bool linear) {
  static const Triple white = xyz_of({1, 1, 1});
  static const std::array<double, 2> neutral = chromaticity(white);
  Triple c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = std::clamp(rgb[k], 0.0, 1.0);
    c[k] = linear ? x : decoded(x);
  }
  const Triple xyz = xyz_of(c);
  const double y = xyz[1] / white[1];
  constexpr double epsilon = 216.0 / 24389, kappa = 24389.0 / 27;
  const double lightness = y > epsilon ? 116 * std::cbrt(y) - 16 : kappa * y;
  if (!(y > 0)) return {0, 0, 0};
  const std::array<double, 2> uv = chromaticity(xyz);
  return {lightness, 13 * lightness * (uv[0] - neutral[0]), 13 * lightness * (uv[1] - neutral[1])};
}

double luv_distance(const std::array<double, 3>& a, const std::array<double, 3>& b, bool linear) {
  const Triple x = luv_of(a, linear), y = luv_of(b, linear);
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

}  // namespace dvrlab
