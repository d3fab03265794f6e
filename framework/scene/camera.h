// Cameras, clipping planes and the two coordinate frames of a config, computed in fp64 and handed to
// framework/kernel/ray.kernel as affine functions of the pixel.
#pragma once

#include <vector>

#include "framework/config/resolved_case.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/kernel_unit.h"

namespace dvrlab {

/// World coordinates relative to the box centre, and the frame "data": origin at that centre, unit = half the diagonal.
class Frame {
 public:
  explicit Frame(const Field& field);
  const Vector3& centre() const { return centre_; }
  /// The point of key `name`, relative to the centre, in world units, as the section's `frame` says.
  Vector3 point(const ParameterSet& s, const std::string& name) const;
  /// World units per unit of the section's frame.
  double unit(const ParameterSet& s) const;

 private:
  Vector3 centre_;
  double half_diagonal_;
};

/// The camera's own axes: where it stands, relative to the centre, what is right and up in the image, and the way back
/// from the target to the eye. Unit vectors, world units.
struct Eye {
  Vector3 position, right, up, back;
};

/// Throws InputError naming the key for a camera that looks nowhere, and for one that has no axes (ray).
Eye eye_of(const Section& camera, const Frame& frame);

/// Adds frame_origin..., frame_direction..., frame_to_grid_*, frame_t0, frame_t1, frame_lo, frame_hi.
/// Throws InputError naming the key for a camera that looks nowhere.
void add_camera(const Section& camera, const Field& field, int width, int height, KernelUnit& unit);

/// Adds frame_planes and frame_plane.
void add_clipping(const std::vector<Section>& planes, const Field& field, KernelUnit& unit);

}  // namespace dvrlab
