// From where unknown data is looked at first.
#pragma once

#include "framework/interfaces/field.h"

namespace dvrlab {

/// In the frame "data": origin at the centre of the data's box, unit = half its diagonal.
struct StarterView {
  Vector3 position{}, target{};
  double fov_deg = 30;
  Vector3 towards_light{};
  double diagonal = 0;    // of the box around what is visible, world units
  double box_voxels = 0;  // grid points in that box
};

/// A square view that every voxel of at least the physical value `cut` fills: from a patient's left front, above; where
/// no anatomy is known from the left front of the world's axes (-x, -y), above. Up is +z.
StarterView starter_view(const GridField& grid, double cut);

}  // namespace dvrlab
