#include "framework/scene/histogram.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "framework/scene/parallel.h"

namespace dvrlab {
namespace {

constexpr std::size_t float_bins = 65536;
constexpr std::uint64_t least_voxels = 1 << 20;

/// count[bin(v[i])] over all voxels, spread over the processors.
template <class T, class Bin>
void count_all(const GridField& grid, std::vector<std::uint64_t>& count, Bin bin) {
  const auto* v = static_cast<const T*>(grid.voxels.get());
  std::mutex guard;
  parallel_ranges(grid.count(), least_voxels, [&](std::uint64_t begin, std::uint64_t end) {
    std::vector<std::uint64_t> mine(count.size());
    for (std::uint64_t i = begin; i < end; ++i) ++mine[bin(v[i])];
    const std::lock_guard lock(guard);
    std::transform(count.begin(), count.end(), mine.begin(), count.begin(), std::plus<>());
  });
}

template <class T>
void count_integers(const GridField& grid, std::vector<std::uint64_t>& count) {
  const int lowest = static_cast<int>(grid.stored_min);
  count_all<T>(grid, count, [lowest](T v) { return static_cast<std::size_t>(static_cast<int>(v) - lowest); });
}

}  // namespace

double Histogram::quantile(double q) const {
  const double wanted = std::max(q * static_cast<double>(total), 1.0);
  std::uint64_t below = 0;
  for (std::size_t b = 0; b < count.size(); ++b) {
    below += count[b];
    if (static_cast<double>(below) >= wanted) return value(b);
  }
  return last();
}

std::uint64_t Histogram::at_least(double v) const {
  std::uint64_t sum = 0;
  for (std::size_t b = count.size(); b-- > 0 && value(b) >= v;) sum += count[b];
  return sum;
}

Histogram Histogram::merged(std::size_t bins) const {
  const std::size_t group = (count.size() + bins - 1) / bins;
  Histogram h{first + 0.5 * static_cast<double>(group - 1) * step, step * static_cast<double>(group), exact, {}, total};
  for (std::size_t b = 0; b < count.size(); b += group) {
    const auto begin = count.begin() + static_cast<std::ptrdiff_t>(b);
    const auto end = count.begin() + static_cast<std::ptrdiff_t>(std::min(b + group, count.size()));
    h.count.push_back(std::accumulate(begin, end, std::uint64_t{0}));
  }
  return h;
}

Histogram histogram_of(const GridField& grid) {
  Histogram h;
  h.exact = grid.type != VoxelType::f32;
  h.total = grid.count();
  const double range = grid.stored_max - grid.stored_min;
  h.count.resize(h.exact ? static_cast<std::size_t>(range) + 1 : range > 0 ? float_bins : 1);
  const double stored_step = h.exact ? 1.0 : h.count.size() > 1 ? range / static_cast<double>(float_bins - 1) : 0.0;
  switch (grid.type) {
    case VoxelType::u8:
      count_integers<std::uint8_t>(grid, h.count);
      break;
    case VoxelType::i8:
      count_integers<std::int8_t>(grid, h.count);
      break;
    case VoxelType::u16:
      count_integers<std::uint16_t>(grid, h.count);
      break;
    case VoxelType::i16:
      count_integers<std::int16_t>(grid, h.count);
      break;
    case VoxelType::f32: {
      const double lowest = grid.stored_min, scale = stored_step > 0 ? 1.0 / stored_step : 0.0;
      const double most = static_cast<double>(h.count.size() - 1);
      count_all<float>(grid, h.count, [=](float v) {
        return static_cast<std::size_t>(std::clamp((static_cast<double>(v) - lowest) * scale + 0.5, 0.0, most));
      });
      break;
    }
  }
  if (grid.slope < 0) std::reverse(h.count.begin(), h.count.end());
  h.first = grid.slope * (grid.slope < 0 ? grid.stored_max : grid.stored_min) + grid.intercept;
  h.step = stored_step * std::abs(grid.slope);
  return h;
}

}  // namespace dvrlab
