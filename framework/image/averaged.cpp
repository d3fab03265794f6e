#include "framework/image/averaged.h"

#include <utility>

namespace dvrlab {
namespace {

template <class Real>
std::vector<Real> averaged_numbers(const std::vector<Real>& in, int width, int height, int n) {
  if (in.empty()) return {};
  const std::size_t columns = std::size_t(width / n), rows = std::size_t(height / n), side = std::size_t(n);
  std::vector<Real> out(3 * columns * rows);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t channel = i % 3, x = i / 3 % columns, y = i / 3 / columns;
    double sum = 0;
    for (std::size_t dy = 0; dy < side; ++dy)
      for (std::size_t dx = 0; dx < side; ++dx)
        sum += static_cast<double>(in[3 * ((y * side + dy) * std::size_t(width) + x * side + dx) + channel]);
    out[i] = static_cast<Real>(sum / (static_cast<double>(n) * n));
  }
  return out;
}

}  // namespace

FrameImage averaged(FrameImage image, int n) {
  if (n == 1) return image;
  FrameImage small;
  small.width = image.width / n;
  small.height = image.height / n;
  small.color = averaged_numbers(image.color, image.width, image.height, n);
  small.trans = averaged_numbers(image.trans, image.width, image.height, n);
  small.color64 = averaged_numbers(image.color64, image.width, image.height, n);
  small.trans64 = averaged_numbers(image.trans64, image.width, image.height, n);
  return small;
}

}  // namespace dvrlab
