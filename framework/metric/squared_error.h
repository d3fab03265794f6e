// What metrics share: the check of the sizes and the mean squared error.
#pragma once

#include <array>

#include "framework/interfaces/backend.h"

namespace dvrlab {

/// Throws InputError with both sizes when they differ.
void check_same_size(const FrameImage& image, const FrameImage& reference);

/// Mean over the pixels of the squared difference of the radiance, summed in fp64.
struct SquaredError {
  std::array<double, 3> channel{};
  double pooled = 0;  // over all channels
};
SquaredError mean_squared_error(const FrameImage& image, const FrameImage& reference);

}  // namespace dvrlab
