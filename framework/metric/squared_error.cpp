#include "framework/metric/squared_error.h"

#include "framework/interfaces/error.h"

namespace dvrlab {

void check_same_size(const FrameImage& image, const FrameImage& reference) {
  if (image.width == reference.width && image.height == reference.height) return;
  const auto size = [](const FrameImage& i) { return std::to_string(i.width) + " x " + std::to_string(i.height); };
  throw InputError("images of different size cannot be compared: " + size(image) + " and, as the reference, " +
                   size(reference));
}

SquaredError mean_squared_error(const FrameImage& image, const FrameImage& reference) {
  check_same_size(image, reference);
  SquaredError e;
  for (std::size_t i = 0; i < image.color.size(); ++i) {
    const double d = image.radiance(i) - reference.radiance(i);
    e.channel[i % 3] += d * d;
  }
  const double pixels = static_cast<double>(image.width) * image.height;
  for (double& c : e.channel) c /= pixels;
  e.pooled = (e.channel[0] + e.channel[1] + e.channel[2]) / 3;
  return e;
}

}  // namespace dvrlab
