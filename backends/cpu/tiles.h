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

/// The modules of a job with their state for this frame; Real is double in precision fp64.
template <class Real>
struct FrameModules {
  ModuleFrame<Real> sampler, estimator, march;
  int width, columns;     // lanes of a packet, pixels of a packet in x
  unsigned packet_bytes;  // of dvr_packet::walk
  FrameModules(const FrameJob& job, const std::string& isa, const std::string& march_folder, ModuleCache& modules);

 private:
  FrameModules(const FrameJob& job, const dvr_kernel_module* sampler_module, const dvr_kernel_module* estimator_module,
               const dvr_kernel_module* march_module, Bindings bindings);
};

/// The sampler's own memory of one packet (FrameModules::packet_bytes).
class WalkMemory {
 public:
  explicit WalkMemory(unsigned bytes);
  ~WalkMemory();
  WalkMemory(const WalkMemory&) = delete;
  WalkMemory& operator=(const WalkMemory&) = delete;
  void* get() const { return memory_; }

 private:
  void* memory_;
};

/// `isa` chooses among the modules in fp32; precision fp64 has its own.
void render_tiles(const FrameJob& job, const std::string& isa, const std::string& march_folder, ModuleCache& modules,
                  const TileOptions& options, FrameResult& result);

}  // namespace dvrlab::cpu
