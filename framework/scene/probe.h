// One ray of a scene, segment by segment: what `dvrlab probe` shows.
#pragma once

#include <vector>

#include "framework/interfaces/backend.h"
#include "framework/plugin/registry.h"
#include "framework/scene/scene.h"

namespace dvrlab {

/// All composited segments of the ray of pixel (x, y), on the cpu backend. The pixel lies in the image.
std::vector<ProbeSegment> probe_ray(const Scene& scene, const Registry& registry, int x, int y);

}  // namespace dvrlab
