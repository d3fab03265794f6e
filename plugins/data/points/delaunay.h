// Delaunay's tetrahedra of scattered points, by Qhull.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/interfaces/parameter_set.h"

namespace dvrlab::points {

/// Corners as indices of points. Throws InputError, `name` in front, with Qhull's words: fewer than five points, all in
/// a plane.
std::vector<std::array<std::uint32_t, 4>> delaunay(const std::vector<Vector3>& points, const std::string& name);

}  // namespace dvrlab::points
