// A metric compares an image with a reference of the same size.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/interfaces/backend.h"
#include "framework/interfaces/parameter_set.h"
#include "framework/interfaces/plugin.h"

namespace dvrlab {

class MetricPlugin : public Plugin {
 public:
  enum class Better { higher, lower };
  /// Which of two values of this metric is the better one: "worst over views" needs to know.
  virtual Better better() const = 0;
  /// Named values, the headline first: {"psnr", 41.2}, {"psnr.r", ...}. Units are the plugin's documentation.
  virtual std::vector<std::pair<std::string, double>> compare(const ParameterSet& parameters, const FrameImage& image,
                                                              const FrameImage& reference) const = 0;
};

}  // namespace dvrlab
