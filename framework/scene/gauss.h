// Gauss-Legendre quadrature as the kernels read it.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace dvrlab {

/// The points on [0, 1] as (x, weight, 0, 0), exact to the degree 2 points - 1.
inline std::vector<double> gauss_rows(int points) {
  std::vector<double> rows;
  for (int k = 1; k <= points; ++k) {
    double x = std::cos(std::numbers::pi * (k - 0.25) / (points + 0.5)), slope = 1;
    for (int newton = 0; newton < 50; ++newton) {
      double p0 = 1, p1 = x;
      for (int n = 2; n <= points; ++n) {
        const double p2 = ((2 * n - 1) * x * p1 - (n - 1) * p0) / n;
        p0 = p1;
        p1 = p2;
      }
      slope = points * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
    }
    const double weight = 1.0 / ((1 - x * x) * slope * slope);
    rows.insert(rows.end(), {(1 + x) / 2, weight, 0.0, 0.0});
  }
  return rows;
}

}  // namespace dvrlab
