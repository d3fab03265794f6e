// A light volume in levels, laid beside the voxels that have the same points (framework/kernel/cpu/beside.h): one fetch
// brings both. The same picture, bit for bit; it only takes memory and saves time.
#pragma once

#include <optional>
#include <string>

#include "framework/interfaces/backend.h"

namespace dvrlab::cpu {

class LightBeside {
 public:
  /// The job with the buffer frame_light_beside, where its sampler can read it; else nothing. Made anew when voxels or
  /// levels are others than last time, and then timed.
  std::optional<FrameJob> add(const FrameJob& job, std::vector<PhaseTime>& times);
  /// Bytes that add() would take.
  static std::uint64_t bytes_for(const FrameJob& job);

 private:
  bool cells_of(const KernelUnit& sampler);

  std::string asked_;  // the sampler of which cells_ is known
  bool cells_ = false;
  std::shared_ptr<const void> voxels_, levels_;
  Buffer beside_;
};

}  // namespace dvrlab::cpu
