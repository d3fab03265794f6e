// One stage of a light volume on the CPU: rows of voxels on all cores.
#pragma once

#include <string>

#include "backends/cpu/modules.h"
#include "framework/interfaces/backend.h"

namespace dvrlab::cpu {

/// `isa` chooses among the modules in fp32; precision fp64 has its own.
void fill_volume(const StageJob& job, const std::string& isa, int threads, ModuleCache& modules, LightVolume& volume);

}  // namespace dvrlab::cpu
