#include "framework/metric/difference_image.h"

#include <algorithm>
#include <array>

#include "framework/metric/luv.h"

namespace dvrlab {
namespace {

using Color = std::array<float, 3>;
constexpr double most = 14;  // of the scale

Color color_of(double e) {
  if (e < 1) return Color{float(0.45 * e), float(0.45 * e), float(0.45 * e)};
  struct Stop {
    double at;
    Color color;
  };
  static const std::array<Stop, 4> stops{
      {{1, {0.1f, 0.2f, 1}}, {3, {0, 0.8f, 0.4f}}, {6, {1, 0.9f, 0}}, {12, {1, 0, 0}}}};
  for (std::size_t k = 1; k < stops.size(); ++k) {
    if (e >= stops[k].at) continue;
    const auto w = static_cast<float>((e - stops[k - 1].at) / (stops[k].at - stops[k - 1].at));
    Color c;
    for (std::size_t i = 0; i < 3; ++i) c[i] = stops[k - 1].color[i] + w * (stops[k].color[i] - stops[k - 1].color[i]);
    return c;
  }
  return stops.back().color;
}

/// A bar over the whole width, ticks at the marks.
void draw_scale(FrameImage& image, int first_row) {
  for (int y = first_row; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      Color c = color_of(most * (x + 0.5) / image.width);
      for (const double mark : {1.0, 3.0, 6.0, 12.0})
        if (x == static_cast<int>(mark / most * image.width) && y - first_row < (image.height - first_row) / 2)
          c = {1, 1, 1};
      if (y == first_row) c = {0, 0, 0};
      std::copy(c.begin(), c.end(), image.color.begin() + 3 * (std::ptrdiff_t(y) * image.width + x));
    }
  }
}

}  // namespace

FrameImage difference_image(const FrameImage& a, const FrameImage& b, bool linear) {
  FrameImage image;
  image.width = a.width;
  const int bar = std::max(6, a.height / 32);
  image.height = a.height + bar;
  const std::size_t pixels = std::size_t(a.width) * std::size_t(a.height);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto color = [&](const FrameImage& f) {
      return std::array{f.radiance(3 * i), f.radiance(3 * i + 1), f.radiance(3 * i + 2)};
    };
    const Color c = color_of(luv_distance(color(a), color(b), linear));
    image.color.insert(image.color.end(), c.begin(), c.end());
  }
  image.color.resize(3 * std::size_t(image.width) * std::size_t(image.height));
  image.trans.assign(image.color.size(), 0.0f);
  draw_scale(image, a.height);
  return image;
}

}  // namespace dvrlab
