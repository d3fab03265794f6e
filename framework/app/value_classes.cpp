#include "framework/app/value_classes.h"

#include <algorithm>
#include <vector>

namespace dvrlab {
namespace {

constexpr std::size_t otsu_bins = 256;
constexpr double rare = 0.9995;  // a share of voxels beyond it decides nothing: metal, noise

/// Voxels of each of three classes, their sum of values, and what Otsu maximises.
double between_classes(const std::vector<double>& count, const std::vector<double>& moment, std::size_t a,
                       std::size_t b) {
  const auto part = [](const std::vector<double>& sums, std::size_t from, std::size_t to) {
    return sums[to] - sums[from];
  };
  const std::size_t end = count.size() - 1, bounds[] = {0, a, b, end};
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double n = part(count, bounds[c], bounds[c + 1]), m = part(moment, bounds[c], bounds[c + 1]);
    if (n > 0) sum += m * m / n;
  }
  return sum;
}

}  // namespace

ValueClasses value_classes(const Histogram& h) {
  const double first = h.first, top = std::max(h.quantile(rare), first + h.step);
  const double width = (top - first) / static_cast<double>(otsu_bins);
  std::vector<double> count(otsu_bins + 1), moment(otsu_bins + 1);  // sums up to each edge
  if (!(width > 0)) return {first, first, first};
  for (std::size_t b = 0; b < h.count.size(); ++b) {
    const double at = std::min((h.value(b) - first) / width, static_cast<double>(otsu_bins) - 1);
    count[static_cast<std::size_t>(at) + 1] += static_cast<double>(h.count[b]);
    moment[static_cast<std::size_t>(at) + 1] += static_cast<double>(h.count[b]) * at;
  }
  for (std::size_t b = 1; b <= otsu_bins; ++b) {
    count[b] += count[b - 1];
    moment[b] += moment[b - 1];
  }
  std::size_t cut = 1, dense = 2;
  double best = -1;
  for (std::size_t a = 1; a + 1 < otsu_bins; ++a) {
    for (std::size_t b = a + 1; b < otsu_bins; ++b) {
      const double value = between_classes(count, moment, a, b);
      if (value > best) best = value, cut = a, dense = b;
    }
  }
  return {first + static_cast<double>(cut) * width, first + static_cast<double>(dense) * width, top};
}

}  // namespace dvrlab
