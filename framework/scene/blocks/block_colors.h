// What a value looks like, and how much it matters that another one stands in its place.
#pragma once

#include <array>
#include <vector>

#include "framework/interfaces/blocks.h"

namespace dvrlab {

/// Colours of the entries of the medium's table: of a slab one voxel thick, unlit, over black and over white, since
/// either alone is blind for dark or for bright matter.
class BlockColors {
 public:
  BlockColors(const ArrangeInput& input, double voxel);
  /// Square of the distance in CIELUV of what two stored values look like, the mean over both backgrounds, and of
  /// nothing and the surfaces between the values.
  double square(float a, float b) const {
    const std::size_t i = entry(a), j = entry(b);
    if (i == j) return 0;
    double sum = 0;
    for (std::size_t k = 0; k < 6; ++k) {
      const double d = color_[i][k] - color_[j][k];
      sum += d * d;
    }
    return surfaces_ ? sum + surface_square(i, j) : sum;
  }
  /// True if a slab of it is not like nothing.
  bool visible(float v) const { return visible_[entry(v)]; }

 private:
  std::size_t entry(float v) const {
    const double x = (double(v) - lo_) * scale_ + 0.5;
    return x <= 0 ? 0 : x >= double(color_.size() - 1) ? color_.size() - 1 : std::size_t(x);
  }
  double surface_square(std::size_t i, std::size_t j) const;

  double lo_, scale_;
  bool surfaces_, linear_;
  std::vector<std::array<float, 6>> color_;
  std::vector<bool> visible_;
  std::vector<std::array<double, 6>> below_;  // depth of the surfaces below an entry, and what they send
};

}  // namespace dvrlab
