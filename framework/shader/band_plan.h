// How many rows one dispatch takes: short enough for a display driver's watchdog.
#pragma once

#include <algorithm>

#include "framework/shader/shader.h"

namespace dvrlab {

/// Starts small, then follows the measured time of the previous band. Only the time depends on it, never the image.
class BandPlan {
 public:
  explicit BandPlan(double target_seconds) : target_(target_seconds) {}

  /// Rows of the next band, a multiple of the workgroup's.
  int rows(int remaining, int largest) const { return std::min({whole_groups(remaining + group - 1), rows_, largest}); }
  /// Grows at most fourfold: the image's next rows may be heavier than these.
  void measured(int rows, double seconds) {
    const double fitting = seconds > 0 ? rows * target_ / seconds : 4.0 * rows;
    rows_ = std::max(group, whole_groups(int(std::min(fitting, 4.0 * rows))));
  }

 private:
  static constexpr int group = ComposedShader::workgroup;
  static int whole_groups(int rows) { return rows / group * group; }
  double target_;
  int rows_ = 4 * group;
};

}  // namespace dvrlab
