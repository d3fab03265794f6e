// Variance of the luminance inside regions that are homogeneous in the reference: noise where there is nothing to see.
#include <cmath>
#include <limits>
#include <vector>

#include "framework/interfaces/metric.h"
#include "framework/metric/squared_error.h"

namespace dvrlab::region_variance {
namespace {

using enum ParameterType;

constexpr Parameter parameters[] = {
    {"radius", integer, "pixel", "3", "[1,64]", "Windows have 2 radius + 1 pixels along each side.", Affects::nothing},
    {"threshold", number, "", "0.01", "[0,inf)",
     "A window is homogeneous where the standard deviation of the reference's luminance is at most this.",
     Affects::nothing},
    {"opacity", number, "", "0.5", "[0,1]", "Least opacity of the reference in every pixel of a window: no background.",
     Affects::nothing},
};

double luminance(const FrameImage& f, std::size_t pixel) {  // ITU-R BT.709
  return 0.2126 * f.radiance(3 * pixel) + 0.7152 * f.radiance(3 * pixel + 1) + 0.0722 * f.radiance(3 * pixel + 2);
}

double opacity(const FrameImage& f, std::size_t pixel) {
  return 1 - (f.transmittance(3 * pixel) + f.transmittance(3 * pixel + 1) + f.transmittance(3 * pixel + 2)) / 3;
}

/// Sums over rectangles in constant time: entry (x, y) is the sum of all pixels left of x and above y.
class SummedArea {
 public:
  template <class ValueOf>
  SummedArea(int width, int height, ValueOf value)
      : width_(width + 1), sum_(std::size_t(width + 1) * std::size_t(height + 1), 0.0) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        sum_[at(x + 1, y + 1)] = value(std::size_t(y) * std::size_t(width) + std::size_t(x)) + sum_[at(x, y + 1)] +
                                 sum_[at(x + 1, y)] - sum_[at(x, y)];
  }
  double mean(int x, int y, int radius) const {
    const int x0 = x - radius, x1 = x + radius + 1, y0 = y - radius, y1 = y + radius + 1;
    return (sum_[at(x1, y1)] - sum_[at(x0, y1)] - sum_[at(x1, y0)] + sum_[at(x0, y0)]) /
           (static_cast<double>(x1 - x0) * (y1 - y0));
  }

 private:
  std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }
  int width_;
  std::vector<double> sum_;
};

/// Mean and mean square of the luminance.
struct Moments {
  explicit Moments(const FrameImage& f)
      : first(f.width, f.height, [&](std::size_t i) { return luminance(f, i); }),
        second(f.width, f.height, [&](std::size_t i) { return luminance(f, i) * luminance(f, i); }) {}
  double variance(int x, int y, int radius) const {
    const double m = first.mean(x, y, radius);
    return std::fmax(second.mean(x, y, radius) - m * m, 0.0);
  }
  SummedArea first, second;
};

class RegionVariance : public MetricPlugin {
 public:
  Better better() const override { return Better::lower; }
  std::vector<std::pair<std::string, double>> compare(const ParameterSet& p, const FrameImage& image,
                                                      const FrameImage& reference) const override {
    check_same_size(image, reference);
    const int radius = static_cast<int>(p.integer("radius"));
    const double threshold = p.number("threshold"), covered = p.number("opacity");
    const Moments mine(image), its(reference);
    const SummedArea background(reference.width, reference.height,
                                [&](std::size_t i) { return opacity(reference, i) < covered ? 1.0 : 0.0; });
    double sum = 0, sum_reference = 0, square = 0, windows = 0;
    for (int y = radius; y + radius < image.height; ++y) {
      for (int x = radius; x + radius < image.width; ++x) {
        const double flat = its.variance(x, y, radius);
        if (flat > threshold * threshold || background.mean(x, y, radius) > 0) continue;
        sum += mine.variance(x, y, radius);
        sum_reference += flat;
        square += mine.first.mean(x, y, radius) * mine.first.mean(x, y, radius);
        ++windows;
      }
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {{"region_variance", windows > 0 ? sum / windows : nan},
            {"region_variance.relative", windows > 0 ? sum / square : nan},
            {"region_variance.reference", windows > 0 ? sum_reference / windows : nan},
            {"region_variance.area", windows / (static_cast<double>(image.width) * image.height)}};
  }
};

}  // namespace

DVRLAB_PLUGIN("metric", "region_variance", "1.0.0", RegionVariance, parameters,
              "Variance of the luminance in regions that are homogeneous in the reference.", "")

}  // namespace dvrlab::region_variance
