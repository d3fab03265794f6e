// How the transmittance of two images differs, by sign: does adding matter ever let more light through?
#include <algorithm>

#include "framework/interfaces/metric.h"
#include "framework/metric/squared_error.h"

namespace dvrlab::transmittance {
namespace {

class Transmittance : public MetricPlugin {
 public:
  Better better() const override { return Better::lower; }
  std::vector<std::pair<std::string, double>> compare(const ParameterSet&, const FrameImage& image,
                                                      const FrameImage& reference) const override {
    check_same_size(image, reference);
    double rise = 0, fall = 0, sum = 0;
    for (std::size_t i = 0; i < image.trans.size(); ++i) {
      const double d = image.transmittance(i) - reference.transmittance(i);
      if (!(d == d)) rise = d;  // a NaN stays
      rise = d > rise ? d : rise;
      fall = -d > fall ? -d : fall;
      sum += d;
    }
    return {{"transmittance", rise == rise ? std::max(rise, fall) : rise},
            {"transmittance.rise", rise},
            {"transmittance.fall", fall},
            {"transmittance.mean", sum / static_cast<double>(image.trans.size())}};
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("metric", "transmittance", "1.0.0", Transmittance,
                    "Largest rise and fall of the transmittance over that of the reference.", "")

}  // namespace dvrlab::transmittance
