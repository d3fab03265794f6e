// Peak signal to noise ratio of the radiance.
#include <cmath>
#include <limits>

#include "framework/interfaces/metric.h"
#include "framework/metric/squared_error.h"

namespace dvrlab::psnr {
namespace {

constexpr Parameter parameters[] = {{"peak", ParameterType::number, "radiance", "1", "(0,inf)",
                                     "The largest radiance, to which the error is related.", Affects::nothing}};

double decibel(double peak, double mean_squared) {
  if (mean_squared == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(peak * peak / mean_squared);
}

class Psnr : public MetricPlugin {
 public:
  Better better() const override { return Better::higher; }
  std::vector<std::pair<std::string, double>> compare(const ParameterSet& p, const FrameImage& image,
                                                      const FrameImage& reference) const override {
    const SquaredError e = mean_squared_error(image, reference);
    const double peak = p.number("peak");
    const double r = decibel(peak, e.channel[0]), g = decibel(peak, e.channel[1]), b = decibel(peak, e.channel[2]);
    return {{"psnr", decibel(peak, e.pooled)},
            {"psnr.mean_db", (r + g + b) / 3},
            {"psnr.r", r},
            {"psnr.g", g},
            {"psnr.b", b}};
  }
};

}  // namespace

DVRLAB_PLUGIN("metric", "psnr", "1.0.0", Psnr, parameters,
              "Peak signal to noise ratio in dB: pooled over all channels, mean of the channels, per channel.", "")

}  // namespace dvrlab::psnr
