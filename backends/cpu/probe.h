// One ray, segment by segment.
#pragma once

#include <string>
#include <vector>

#include "backends/cpu/modules.h"
#include "framework/interfaces/backend.h"

namespace dvrlab::cpu {

std::vector<ProbeSegment> probe_ray(const FrameJob& job, const std::string& isa, const std::string& march_folder,
                                    ModuleCache& modules, int x, int y);

}  // namespace dvrlab::cpu
