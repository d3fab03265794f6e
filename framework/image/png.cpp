#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "framework/image/atomic_file.h"
#include "framework/image/image_io.h"

namespace dvrlab {
namespace {

double encode_srgb(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; }

std::uint8_t to_byte(float value, bool linear) {
  double x = value > 0.0f ? std::min(static_cast<double>(value), 1.0) : 0.0;  // NaN compares false
  if (linear) x = encode_srgb(x);
  return static_cast<std::uint8_t>(std::floor(255.0 * x + 0.5));
}

}  // namespace

void write_png(const std::string& file, const FrameImage& image, bool linear) {
  std::vector<std::uint8_t> bytes(image.color.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = to_byte(image.color[i], linear);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  write_atomically(file, [&](const std::string& temporary) {
    if (!png_image_write_to_file(&png, temporary.c_str(), 0, bytes.data(), 0, nullptr))
      throw std::runtime_error(png.message);
  });
}

}  // namespace dvrlab
