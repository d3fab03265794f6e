#include "tests/support/reference.h"

#include <cmath>

namespace dvrlab::test {

std::array<double, 3> nodes_at(const nlohmann::json& nodes, double v) {
  const auto x = [&](std::size_t k, std::size_t c) { return nodes[k][nodes[k].size() == 2 ? 1 : c + 1].get<double>(); };
  std::size_t k = 0;
  while (k < nodes.size() && nodes[k][0].get<double>() <= v) ++k;
  std::array<double, 3> r{};
  for (std::size_t c = 0; c < 3; ++c) {
    if (k == 0) {
      r[c] = x(0, c);
    } else if (k == nodes.size()) {
      r[c] = x(k - 1, c);
    } else {
      const double a = nodes[k - 1][0].get<double>(), b = nodes[k][0].get<double>();
      r[c] = x(k - 1, c) + (x(k, c) - x(k - 1, c)) * (v - a) / (b - a);
    }
  }
  return r;
}

RayIntegral integrate(const nlohmann::json& extinction, const nlohmann::json& color,
                      const std::function<double(double)>& v, double D, int panels) {
  // 5-point Gauss-Legendre on [0, 1]
  constexpr std::array<double, 5> x = {0.046910077030668, 0.2307653449471585, 0.5, 0.7692346550528415,
                                       0.953089922969332};
  constexpr std::array<double, 5> w = {0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
                                       0.118463442528095};
  RayIntegral r;
  std::array<double, 3> depth{};
  const double h = D / panels;
  for (int p = 0; p < panels; ++p) {
    std::array<double, 3> panel{};
    for (std::size_t q = 0; q < 5; ++q) {
      const double l = (p + x[q]) * h, value = v(l);
      const auto mu = nodes_at(extinction, value), c = nodes_at(color, value);
      // Depth inside the panel by the trapezoid from its front end: panels are thin.
      const auto mu0 = nodes_at(extinction, v(p * h));
      for (std::size_t k = 0; k < 3; ++k) {
        const double inside = depth[k] + 0.5 * (mu0[k] + mu[k]) * x[q] * h;
        r.I[k] += w[q] * h * c[k] * mu[k] * std::exp(-inside);
        panel[k] += w[q] * h * mu[k];
      }
    }
    for (std::size_t k = 0; k < 3; ++k) depth[k] += panel[k];
  }
  for (std::size_t k = 0; k < 3; ++k) r.T[k] = std::exp(-depth[k]);
  return r;
}

}  // namespace dvrlab::test
