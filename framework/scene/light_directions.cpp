#include "framework/interfaces/light_directions.h"

#include <algorithm>
#include <cmath>

#include "framework/scene/vector.h"

namespace dvrlab {
namespace {

using Face = std::array<Vector3, 3>;

Vector3 normalized(const Vector3& a) { return times(a, 1 / length(a)); }

std::vector<Face> faces_of(Solid solid) {
  if (solid == Solid::tetrahedron) {
    const Vector3 a{1, 1, 1}, b{1, -1, -1}, c{-1, 1, -1}, d{-1, -1, 1};
    return {{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}};
  }
  std::vector<Face> faces;
  if (solid == Solid::octahedron) {
    for (const double x : {1.0, -1.0})
      for (const double y : {1.0, -1.0})
        for (const double z : {1.0, -1.0}) faces.push_back({Vector3{x, 0, 0}, Vector3{0, y, 0}, Vector3{0, 0, z}});
    return faces;
  }
  // Corners of an icosahedron are (0, +-1, +-phi) and its cyclic shifts; three of them at distance 2 are a face.
  const double phi = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vector3> corner;
  for (const double s : {1.0, -1.0})
    for (const double t : {phi, -phi}) corner.insert(corner.end(), {{0, s, t}, {s, t, 0}, {t, 0, s}});
  const auto near = [&](std::size_t i, std::size_t j) {
    return std::abs(length(minus(corner[i], corner[j])) - 2) < 1e-9;
  };
  for (std::size_t i = 0; i < corner.size(); ++i)
    for (std::size_t j = i + 1; j < corner.size(); ++j)
      for (std::size_t k = j + 1; k < corner.size(); ++k)
        if (near(i, j) && near(j, k) && near(i, k)) faces.push_back({corner[i], corner[j], corner[k]});
  return faces;
}

std::vector<Face> divided(const std::vector<Face>& faces) {
  std::vector<Face> parts;
  for (const Face& f : faces) {
    const Vector3 ab = normalized(plus(f[0], f[1])), bc = normalized(plus(f[1], f[2])),
                  ca = normalized(plus(f[2], f[0]));
    parts.insert(parts.end(), {{f[0], ab, ca}, {f[1], bc, ab}, {f[2], ca, bc}, {ab, bc, ca}});
  }
  return parts;
}

/// Of a spherical triangle with corners on the unit sphere (Van Oosterom and Strackee 1983).
double solid_angle(const Face& f) {
  const double volume = std::abs(dot(f[0], cross(f[1], f[2])));
  return 2 * std::atan2(volume, 1 + dot(f[0], f[1]) + dot(f[1], f[2]) + dot(f[2], f[0]));
}

/// The turn that brings unit vector a to unit vector b, on the shortest way.
Vector3 turned(const Vector3& x, const Vector3& a, const Vector3& b) {
  const Vector3 axis = cross(a, b);
  const double c = dot(a, b), s2 = dot(axis, axis);
  if (s2 < 1e-24 && c > 0) return x;
  if (s2 < 1e-24) {  // half a turn about any axis at right angles to a
    const Vector3 n = normalized(cross(a, std::abs(a[0]) < 0.9 ? Vector3{1, 0, 0} : Vector3{0, 1, 0}));
    return minus(times(n, 2 * dot(n, x)), x);
  }
  return plus(plus(times(x, c), cross(axis, x)), times(axis, dot(axis, x) * (1 - c) / s2));
}

/// The first stays; each of the others is the one farthest from those before it.
void spread(std::vector<LightDirection>& d) {
  std::vector<double> nearest(d.size(), -2);  // cosine to the nearest of those that are placed
  for (std::size_t placed = 1; placed < d.size(); ++placed) {
    std::size_t best = placed;
    for (std::size_t i = placed; i < d.size(); ++i) {
      nearest[i] = std::max(nearest[i], dot(d[i].omega, d[placed - 1].omega));
      if (nearest[i] < nearest[best] - 1e-9) best = i;
    }
    std::swap(d[placed], d[best]);
    std::swap(nearest[placed], nearest[best]);
  }
}

}  // namespace

std::vector<LightDirection> light_directions(Solid solid, int subdivisions, bool by_solid_angle,
                                             const Vector3& toward) {
  std::vector<Face> faces = faces_of(solid);
  for (Face& f : faces)
    for (Vector3& corner : f) corner = normalized(corner);
  for (int k = 0; k < subdivisions; ++k) faces = divided(faces);
  std::vector<LightDirection> directions;
  double sum = 0;
  for (const Face& f : faces) {
    directions.push_back({normalized(plus(plus(f[0], f[1]), f[2])), by_solid_angle ? solid_angle(f) : 1.0});
    sum += directions.back().weight;
  }
  const Vector3 first = directions.front().omega;
  for (LightDirection& d : directions) {
    d.omega = turned(d.omega, first, toward);
    d.weight /= sum;
  }
  spread(directions);
  return directions;
}

}  // namespace dvrlab
