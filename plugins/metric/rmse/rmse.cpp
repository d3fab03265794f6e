// Root mean square error of the radiance.
#include <cmath>

#include "framework/interfaces/metric.h"
#include "framework/metric/squared_error.h"

namespace dvrlab::rmse {
namespace {

class Rmse : public MetricPlugin {
 public:
  Better better() const override { return Better::lower; }
  std::vector<std::pair<std::string, double>> compare(const ParameterSet&, const FrameImage& image,
                                                      const FrameImage& reference) const override {
    const SquaredError e = mean_squared_error(image, reference);
    return {{"rmse", std::sqrt(e.pooled)},
            {"rmse.r", std::sqrt(e.channel[0])},
            {"rmse.g", std::sqrt(e.channel[1])},
            {"rmse.b", std::sqrt(e.channel[2])}};
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("metric", "rmse", "1.0.0", Rmse,
                    "Root mean square error of the radiance, over all channels and per channel.", "")

}  // namespace dvrlab::rmse
