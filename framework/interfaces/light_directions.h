// Directions over the sphere, for passes that gather light from all around (Hernell et al. 2008, section 4).
#pragma once

#include <vector>

#include "framework/interfaces/parameter_set.h"

namespace dvrlab {

enum class Solid { tetrahedron, octahedron, icosahedron };

struct LightDirection {
  Vector3 omega;  // unit length, world
  double weight;  // sum 1
};

/// The centres of the solid's faces (4, 8, 20), each cut into four `subdivisions` times, turned so that the first
/// direction is `toward` (unit length). The others follow so that each is as far from those before it as can be: any
/// first k of them spread over the sphere. Weights are equal, or the solid angles of the faces.
std::vector<LightDirection> light_directions(Solid solid, int subdivisions, bool by_solid_angle, const Vector3& toward);

}  // namespace dvrlab
