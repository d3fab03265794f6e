// How a grid lies in the world, in words.
#pragma once

#include <array>
#include <string>

#include "framework/interfaces/field.h"

namespace dvrlab {

/// One index axis of a field.
struct AxisDirection {
  double spacing = 0;    // world units from one grid point to the next
  Vector3 direction{};   // unit vector in the world
  int world_axis = 0;    // the nearest: 0 x, 1 y, 2 z
  bool forwards = true;  // along it, or against it
  double angle_deg = 0;  // between the two; 0 when they agree to 0.01 degree
};

std::array<AxisDirection, 3> axis_directions(const Field& field);

/// "x index runs from right to left", for a patient's world; "x index runs along +x" else; with the angle when the axis
/// is oblique.
std::string axis_words(const AxisDirection& axis, int index_axis, bool anatomical);

/// "LAS": where each index axis points to, for a patient's world.
std::string orientation_code(const Field& field);

}  // namespace dvrlab
