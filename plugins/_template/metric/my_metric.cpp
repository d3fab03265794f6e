// The `my_metric` metric: the mean absolute difference.
#include <cmath>

#include "framework/interfaces/metric.h"

namespace dvrlab::my_metric {
namespace {

const Parameter parameters[] = {
    {"of", ParameterType::choice, "", "\"radiance\"", "radiance|transmittance", "What is compared.", Affects::pixels,
     "", "\"transmittance\""},
};

class MyMetric : public MetricPlugin {
 public:
  Better better() const override { return Better::lower; }
  // The images have the same size. The first value is the headline; further ones are named my_metric.<part>.
  std::vector<std::pair<std::string, double>> compare(const ParameterSet& p, const FrameImage& image,
                                                      const FrameImage& reference) const override {
    const bool radiance = p.text("of") == "radiance";
    const std::vector<float>& a = radiance ? image.color : image.trans;
    const std::vector<float>& b = radiance ? reference.color : reference.trans;
    double sum[3] = {0, 0, 0};
    for (std::size_t i = 0; i < a.size(); ++i) sum[i % 3] += std::abs(double(a[i]) - double(b[i]));
    const double pixels = double(a.size()) / 3;
    return {{"my_metric", (sum[0] + sum[1] + sum[2]) / (3 * pixels)},
            {"my_metric.r", sum[0] / pixels},
            {"my_metric.g", sum[1] / pixels},
            {"my_metric.b", sum[2] / pixels}};
  }
};

}  // namespace

DVRLAB_PLUGIN("metric", "my_metric", "0.1", MyMetric, parameters,
              "mean absolute difference of the radiance or the transmittance, over all channels and per channel", "")

}  // namespace dvrlab::my_metric
