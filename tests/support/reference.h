// An fp64 reference of the volume rendering integral along one ray, independent of the framework's code: transfer
// functions from nodes, Gauss-Legendre panels.
#pragma once

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

namespace dvrlab::test {

struct RayIntegral {
  std::array<double, 3> I{}, T{};  // radiance with background, transmittance
};

/// Piecewise linear nodes [[v, x], ...] or [[v, r, g, b], ...]; the right value at a jump.
std::array<double, 3> nodes_at(const nlohmann::json& nodes, double v);

/// Absorption-emission: dI = k c mu T dl along v(l), l in [0, D], in `panels` panels of 5 points each.
RayIntegral integrate(const nlohmann::json& extinction, const nlohmann::json& color,
                      const std::function<double(double)>& v, double D, int panels);

}  // namespace dvrlab::test
