// One frame on the CPU: packets of rays in tiles, sampler -> estimator -> compositor in chunks that stay in L1.
#pragma once

#include <string>

#include "backends/cpu/modules.h"
#include "framework/interfaces/backend.h"

namespace dvrlab::cpu {

struct TileOptions {
  int threads = 0;  // 0: all
  int tile = 16;    // pixels
};

void render_tiles(const FrameJob& job, const std::string& isa, const std::string& march_folder, ModuleCache& modules,
                  const TileOptions& options, FrameResult& result);

}  // namespace dvrlab::cpu
