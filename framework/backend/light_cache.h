// Light volumes that a session has filled. What is the same as in an earlier frame is not computed again.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "framework/interfaces/backend.h"

namespace dvrlab {

class LightCache {
 public:
  using Fill = std::function<void(const StageJob&, LightVolume&)>;

  /// The light volume of the job; stages that are missing are run by `fill`. Volumes that this job does not use are
  /// forgotten. Times: one phase per stage, 0 for those that were not run.
  LightVolume volume(const FrameJob& job, const Fill& fill, std::vector<PhaseTime>& times);
  /// The image of a pass that finds it itself, with its standard error and times.
  void image(const FrameJob& job, const Fill& fill, FrameResult& result);

 private:
  struct Run;
  void start(const FrameJob& job);
  void keep_only(const std::set<std::string>& used);
  std::map<std::string, LightVolume> kept_;           // by everything that decides the volume
  std::vector<std::shared_ptr<const void>> sources_;  // the field's memory: while it lives, its address is its name
};

}  // namespace dvrlab
