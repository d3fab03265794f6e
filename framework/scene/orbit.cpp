#include "framework/scene/orbit.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/scene/vector.h"

namespace dvrlab {
namespace {

constexpr double pi = 3.14159265358979323846;
const double golden_angle = pi * (3.0 - std::sqrt(5.0));

/// Height above the plane (sine of the elevation) and angle about the axis.
struct Direction {
  double height, angle;
};

Direction direction_of(const ParameterSet& p, double view) {
  const double views = double(p.integer("views")), start = p.number("start_deg") * pi / 180.0;
  if (p.text("path") == "circle")
    return {std::sin(p.number("elevation_deg") * pi / 180.0), start + 2.0 * pi * view / views};
  return {1.0 - (2.0 * view + 1.0) / views, start + golden_angle * view};
}

}  // namespace

Vector3 orbit_direction(const ParameterSet& p) {
  if (p.is_null("view")) throw InputError(p.path_of("view") + ": null stands for all views; give the index of one");
  const Direction d = direction_of(p, p.json("view").get<double>());
  const Vector3 axis = unit_vector(p.vector3("axis"), p.path_of("axis") + ": is 0; give a direction");
  const auto across = [&](const Vector3& v) { return minus(v, times(axis, dot(v, axis))); };
  Vector3 zero = across({1, 0, 0});
  if (length(zero) < 1e-6) zero = across({0, 1, 0});
  zero = times(zero, 1.0 / length(zero));
  const Vector3 quarter = cross(axis, zero);
  const double flat = std::sqrt(std::max(0.0, 1.0 - d.height * d.height));
  return plus(times(axis, d.height),
              plus(times(zero, flat * std::cos(d.angle)), times(quarter, flat * std::sin(d.angle))));
}

}  // namespace dvrlab
