// Signed mean differences: is one image brighter, or deeper, than the other?
#include <cmath>
#include <limits>

#include "framework/interfaces/metric.h"
#include "framework/metric/squared_error.h"

namespace dvrlab::bias {
namespace {

class Bias : public MetricPlugin {
 public:
  Better better() const override { return Better::lower; }
  std::vector<std::pair<std::string, double>> compare(const ParameterSet&, const FrameImage& image,
                                                      const FrameImage& reference) const override {
    check_same_size(image, reference);
    double channel[3] = {}, depth = 0;
    std::size_t translucent = 0;
    for (std::size_t i = 0; i < image.color.size(); ++i) {
      channel[i % 3] += image.radiance(i) - reference.radiance(i);
      const double t = image.transmittance(i), t_reference = reference.transmittance(i);
      if (!(t > 0) || !(t_reference > 0)) continue;  // opaque: no finite depth
      depth += std::log(t_reference) - std::log(t);
      ++translucent;
    }
    const double pixels = static_cast<double>(image.width) * image.height;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {{"bias", (channel[0] + channel[1] + channel[2]) / (3 * pixels)},
            {"bias.r", channel[0] / pixels},
            {"bias.g", channel[1] / pixels},
            {"bias.b", channel[2] / pixels},
            {"bias.depth", translucent > 0 ? depth / static_cast<double>(translucent) : nan},
            {"bias.opaque", 1 - static_cast<double>(translucent) / (3 * pixels)}};
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("metric", "bias", "1.0.0", Bias, "Mean signed difference of the radiance and of the optical depth.",
                    "")

}  // namespace dvrlab::bias
