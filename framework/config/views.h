// The views of an orbit camera: a permutation axis `camera.view` that nobody writes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "framework/config/axes.h"
#include "framework/config/config_tree.h"

namespace dvrlab {

inline constexpr const char* view_key = "camera.view";

/// How many views the camera of this tree stands for: 0 unless it is an orbit whose `view` is null. A number of views
/// that is illegal counts as 0 too: whoever resolves the camera says so.
std::size_t asked_views(const ConfigTree& tree);

/// True if the camera may be an orbit: as it is written in `tree`, or by one of the axes.
bool may_orbit(const ConfigTree& tree, const std::vector<Axis>& axes);

/// Brings the permutation axes into the running order of an experiment with views, and says how many of them run
/// outside the views: first the axes of the data (each file is loaded once), then those of the camera, inside the
/// views all others (the reference of a view is forgotten before the next view).
std::size_t order_around_views(std::vector<Axis>& axes);

/// "07": as long as the label of the last view, so that files sort.
std::string view_label(std::size_t view, std::size_t views);

}  // namespace dvrlab
