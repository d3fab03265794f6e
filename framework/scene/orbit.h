// Where the views of an orbit camera stand.
#pragma once

#include "framework/interfaces/parameter_set.h"

namespace dvrlab {

/// From the target to the eye of the orbit's `view`, length 1 up to rounding, in the axes of the orbit's frame.
/// path "circle": view i stands at the angle start_deg + 360 i / views about the axis, elevation_deg above the
/// target's plane. path "sphere": views are spread evenly over the sphere (Fibonacci lattice: equal heights, golden
/// angle; Swinbank and Purser 2006, doi:10.1256/qj.05.227), from near the axis' end down; none stands on the axis.
/// Angle 0 is the direction of x, seen along the axis, or of y where the axis is x; angles grow against the clock for
/// who looks against the axis. Throws InputError naming the key when the axis is 0 or the view is null.
Vector3 orbit_direction(const ParameterSet& camera);

}  // namespace dvrlab
