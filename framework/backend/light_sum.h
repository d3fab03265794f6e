// What is made of the stages' volumes: the light volume that the march reads, or the image itself.
#pragma once

#include <vector>

#include "framework/interfaces/backend.h"

namespace dvrlab {

/// The parts' light in the lights' colours, then bias and blend; with its standard error, where parts have one, and its
/// statistics. `parts`: the volumes of each LightPart.
LightVolume sum_of_light(const FrameJob& job, const std::vector<std::vector<const LightVolume*>>& parts);

/// The image and its standard error from the estimates of a pass that finds it itself (LightPlan::image).
void join_image(const FrameJob& job, const std::vector<const LightVolume*>& estimates, FrameResult& result);

}  // namespace dvrlab
