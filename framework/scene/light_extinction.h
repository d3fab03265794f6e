// What light rays see of a medium, as framework/kernel/light_ray.kernel reads it.
#pragma once

#include "framework/interfaces/kernel_unit.h"
#include "framework/interfaces/medium.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

/// The largest entry of light_tau per channel, at scale 1: what lies between entries is not larger.
Vector3 largest_extinction(const Medium& medium, const MediumTableOptions& options);

/// Adds light_tau..., light_surface, light_dirac over the entries of the medium's table: the extinction per world
/// length times `scale`, the depth of surfaces below a value, Dirac terms. An opaque range is a depth of 40 at both of
/// its ends and an extinction of 4000 per voxel inside: transmittances below 1e-15 are 0. Extinctions are linear
/// between entries, whatever `tf` says.
void add_light_extinction(const Medium& medium, const MediumTableOptions& options, double scale, double voxel,
                          KernelUnit& unit);

}  // namespace dvrlab
