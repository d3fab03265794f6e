// The largest absolute difference of any number of the images, and where it is.
#include <cmath>
#include <limits>

#include "framework/interfaces/metric.h"
#include "framework/metric/squared_error.h"

namespace dvrlab::max_abs {
namespace {

struct Worst {
  double difference = 0;
  std::size_t index = 0;
};

// Equal numbers, infinities included, differ by 0. A difference that is not finite counts as infinite.
template <class NumberOf>
Worst worst_of(const FrameImage& a, const FrameImage& b, NumberOf number) {
  Worst worst;
  for (std::size_t i = 0; i < a.color.size(); ++i) {
    const double x = number(a, i), y = number(b, i);
    if (x == y) continue;
    double difference = std::fabs(x - y);
    if (!std::isfinite(difference)) difference = std::numeric_limits<double>::infinity();
    if (difference > worst.difference) worst = {difference, i};
  }
  return worst;
}

class MaxAbs : public MetricPlugin {
 public:
  Better better() const override { return Better::lower; }
  std::vector<std::pair<std::string, double>> compare(const ParameterSet&, const FrameImage& image,
                                                      const FrameImage& reference) const override {
    check_same_size(image, reference);
    const Worst color = worst_of(image, reference, [](const FrameImage& f, std::size_t i) { return f.radiance(i); });
    const Worst trans =
        worst_of(image, reference, [](const FrameImage& f, std::size_t i) { return f.transmittance(i); });
    const Worst& worst = trans.difference > color.difference ? trans : color;
    const std::size_t pixel = worst.index / 3, width = static_cast<std::size_t>(image.width);
    return {{"max_abs", worst.difference},
            {"max_abs.radiance", color.difference},
            {"max_abs.transmittance", trans.difference},
            {"max_abs.x", static_cast<double>(pixel % width)},
            {"max_abs.y", static_cast<double>(pixel / width)}};
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("metric", "max_abs", "1.0.0", MaxAbs,
                    "Largest absolute difference of radiance and transmittance, with the pixel where it is.", "")

}  // namespace dvrlab::max_abs
