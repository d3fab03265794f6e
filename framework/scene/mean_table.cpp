#include "framework/scene/mean_table.h"

#include "framework/interfaces/wide.h"
#include "framework/scene/buffers.h"

namespace dvrlab {
namespace {

typedef double four __attribute__((vector_size(32)));
typedef float four_floats __attribute__((vector_size(16)));

inline __attribute__((always_inline)) void store(float* to, const four& x, four& stored) {
  const four_floats r = __builtin_convertvector(x, four_floats);
  __builtin_memcpy(to, &r, sizeof r);
  stored = __builtin_convertvector(r, four);
}
inline __attribute__((always_inline)) void store(double* to, const four& x, four& stored) {
  __builtin_memcpy(to, &x, sizeof x);
  stored = x;
}

/// Per bin and group: the sum of all bins before it, what rounding took of that, the mean in it. The same numbers on
/// every machine, by its widest instructions.
template <class T>
DVRLAB_WIDE void fill(const BinMedium& bins, T* to) {
  constexpr int most_groups = 8;
  four sum[most_groups] = {};
  const double* from = bins.mean.get();
  for (int j = 0; j < bins.count; ++j) {
    for (int g = 0; g < bins.groups; ++g, to += 12, from += 4) {
      four mean, rounded, unused;
      __builtin_memcpy(&mean, from, sizeof mean);
      store(to, sum[g], rounded);
      store(to + 4, sum[g] - rounded, unused);
      store(to + 8, mean, unused);
      // What lies below the range is never summed up: sums begin at its end.
      if (j > 0) sum[g] += mean;
    }
  }
}

template <class T>
std::shared_ptr<T[]> sums_of(const BinMedium& bins) {
  auto table = std::make_shared_for_overwrite<T[]>(12 * static_cast<std::size_t>(bins.groups) *
                                                   static_cast<std::size_t>(bins.count));
  fill(bins, table.get());
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
