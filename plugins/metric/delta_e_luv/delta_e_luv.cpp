// Perceived colour difference in CIE 1976 L*u*v*: root mean square, and how many pixels differ plainly.
#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/interfaces/metric.h"
#include "framework/metric/luv.h"
#include "framework/metric/squared_error.h"

namespace dvrlab::delta_e_luv {
namespace {

constexpr Parameter parameters[] = {
    {"threshold", ParameterType::number, "Delta E", "6", "(0,inf)", "Differences above it count in the rate.",
     Affects::nothing},
    {"space", ParameterType::choice, "", "\"display\"", "display|linear",
     "What radiances are: display values, which are decoded from sRGB, or linear light.", Affects::nothing},
};

struct Sums {
  double square = 0, above = 0, count = 0;
  void add(double e, double threshold) {
    square += e * e;
    above += e > threshold ? 1 : 0;
    ++count;
  }
  double rms() const { return count > 0 ? std::sqrt(square / count) : std::numeric_limits<double>::quiet_NaN(); }
  double rate() const { return count > 0 ? above / count : std::numeric_limits<double>::quiet_NaN(); }
};

class DeltaELuv : public MetricPlugin {
 public:
  Better better() const override { return Better::lower; }
  std::vector<std::pair<std::string, double>> compare(const ParameterSet& p, const FrameImage& image,
                                                      const FrameImage& reference) const override {
    check_same_size(image, reference);
    const double threshold = p.number("threshold");
    const bool linear = p.text("space") == "linear";
    Sums all, covered;
    double largest = 0;
    const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
    for (std::size_t i = 0; i < pixels; ++i) {
      const auto color = [&](const FrameImage& f) {
        return std::array{f.radiance(3 * i), f.radiance(3 * i + 1), f.radiance(3 * i + 2)};
      };
      const auto clear = [&](const FrameImage& f) {
        return f.transmittance(3 * i) == 1 && f.transmittance(3 * i + 1) == 1 && f.transmittance(3 * i + 2) == 1;
      };
      const double e = luv_distance(color(image), color(reference), linear);
      all.add(e, threshold);
      if (!clear(image) || !clear(reference)) covered.add(e, threshold);
      largest = std::max(largest, e);
    }
    return {{"delta_e_luv", all.rms()},
            {"delta_e_luv.rate", all.rate()},
            {"delta_e_luv.covered", covered.rms()},
            {"delta_e_luv.covered_rate", covered.rate()},
            {"delta_e_luv.max", largest}};
  }
};

}  // namespace

DVRLAB_PLUGIN(
    "metric", "delta_e_luv", "1.0.0", DeltaELuv, parameters,
    "Colour difference in CIE 1976 L*u*v*: root mean square and the rate above 6, of all pixels and of those that are "
    "not "
    "background.",
    "F. Hernell et al. 2008, section 5; P. Ljung et al., Transfer Function Based Adaptive Decompression for Volume "
    "Rendering of Large Medical Data Sets, VolVis 2004, doi:10.1109/SVVG.2004.14")

}  // namespace dvrlab::delta_e_luv
