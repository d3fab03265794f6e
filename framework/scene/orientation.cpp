#include "framework/scene/orientation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dvrlab {
namespace {

constexpr double least_angle_deg = 0.01;  // below it is rounding in a file's decimal numbers

// Of a patient: the two ends of the world's axes.
constexpr const char* ends[3][2] = {{"left", "right"}, {"back", "front"}, {"bottom", "top"}};

}  // namespace

std::array<AxisDirection, 3> axis_directions(const Field& field) {
  std::array<AxisDirection, 3> axes;
  for (std::size_t c = 0; c < 3; ++c) {
    AxisDirection& a = axes[c];
    const auto& m = field.to_world.m;
    a.spacing = std::hypot(m[c], m[3 + c], m[6 + c]);
    for (std::size_t r = 0; r < 3; ++r) a.direction[r] = m[3 * r + c] / a.spacing;
    const auto larger = [](double x, double y) { return std::fabs(x) < std::fabs(y); };
    const auto nearest = std::max_element(a.direction.begin(), a.direction.end(), larger);
    a.world_axis = static_cast<int>(nearest - a.direction.begin());
    a.forwards = *nearest > 0;
    double across = 0;
    for (const double& x : a.direction) across += &x == &*nearest ? 0.0 : x * x;
    a.angle_deg = std::atan2(std::sqrt(across), std::fabs(*nearest)) * 180.0 / 3.14159265358979323846;
    if (a.angle_deg < least_angle_deg) a.angle_deg = 0;
  }
  return axes;
}

std::string axis_words(const AxisDirection& axis, int index_axis, bool anatomical) {
  std::string text = std::string(1, "xyz"[index_axis]) + " index runs ";
  const auto& end = ends[axis.world_axis];
  if (anatomical) {
    text += std::string("from ") + end[axis.forwards ? 0 : 1] + " to " + end[axis.forwards ? 1 : 0];
  } else {
    text += std::string("along ") + (axis.forwards ? "+" : "-") + "xyz"[axis.world_axis];
  }
  if (axis.angle_deg == 0) return text;
  char oblique[48];
  std::snprintf(oblique, sizeof oblique, ", %.3g degrees off", axis.angle_deg);
  return text + oblique;
}

std::string orientation_code(const Field& field) {
  std::string code;
  for (const AxisDirection& a : axis_directions(field)) {
    const char* letters = a.world_axis == 0 ? "LR" : a.world_axis == 1 ? "PA" : "IS";
    code += letters[a.forwards ? 1 : 0];
  }
  return code;
}

}  // namespace dvrlab
