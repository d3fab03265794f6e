#include "framework/scene/mean_table.h"

#include "framework/scene/buffers.h"

namespace dvrlab {
namespace {

/// Per bin and group: the sum of all bins before it, what rounding took of that, the mean in it.
template <class T>
std::shared_ptr<T[]> sums_of(const BinMedium& bins) {
  const std::size_t numbers = 4 * static_cast<std::size_t>(bins.groups);
  auto table = std::make_shared_for_overwrite<T[]>(3 * numbers * static_cast<std::size_t>(bins.count));
  T* to = table.get();
  std::array<double, 4 * 8> sum{};
  for (int j = 0; j < bins.count; ++j) {
    const double* mean = bins.bin(j);
    for (std::size_t g = 0; g < numbers; g += 4, to += 12) {
      for (std::size_t k = 0; k < 4; ++k) {
        const T rounded = static_cast<T>(sum[g + k]);
        to[k] = rounded;
        to[4 + k] = static_cast<T>(sum[g + k] - static_cast<double>(rounded));
        to[8 + k] = static_cast<T>(mean[g + k]);
      }
      // What lies below the range is never summed up: sums begin at its end.
      if (j > 0)
        for (std::size_t k = 0; k < 4; ++k) sum[g + k] += mean[g + k];
    }
  }
  return table;
}

}  // namespace

std::uint64_t mean_table_bytes(int bins, int groups, bool fp64) {
  const auto numbers = 4 * static_cast<std::uint64_t>(groups) * (static_cast<std::uint64_t>(bins) + 2);
  return numbers * (sizeof(double) + 3 * (fp64 ? sizeof(double) : sizeof(float)));
}

void add_means(const BinMedium& bins, bool barycentre, bool fp64, KernelUnit& unit) {
  unit.uniforms.insert(unit.uniforms.end(),
                       {Uniform::real("mean_lo", bins.lo),
                        Uniform::real("mean_scale", bins.count > 0 ? (bins.count - 2) / (bins.hi - bins.lo) : 0),
                        Uniform::real("mean_last", bins.count - 1),
                        Uniform::constant_integer("mean_barycentre", barycentre && bins.count > 0 ? 1 : 0)});
  if (bins.count == 0) {
    unit.buffers.push_back(vec4_buffer("mean_table", {}));
    return;
  }
  const std::uint64_t count = 3 * static_cast<std::uint64_t>(bins.groups) * static_cast<std::uint64_t>(bins.count);
  Buffer buffer{"mean_table", Element::vec4, nullptr, count, nullptr};
  if (fp64)
    buffer.data64 = sums_of<double>(bins);
  else
    buffer.data = sums_of<float>(bins);
  unit.buffers.push_back(std::move(buffer));
}

}  // namespace dvrlab
