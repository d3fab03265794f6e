// From where unknown data is looked at first.
#pragma once

#include <vector>

#include "framework/interfaces/field.h"

namespace dvrlab {

/// In the frame "data": origin at the centre of the data's box, unit = half its diagonal.
struct StarterView {
  Vector3 position{}, target{};
  double fov_deg = 30;
  Vector3 towards_light{};
};

/// A square view that `points` (world units, at least one) fill: from a patient's left front, above; where no anatomy
/// is known from the left front of the world's axes (-x, -y), above. Up is +z.
StarterView starter_view(std::vector<Vector3> points, const Field& field);

}  // namespace dvrlab
