#include "plugins/estimator/power_series/moment_table.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <type_traits>

#include "framework/interfaces/wide.h"

namespace dvrlab::power_series {
namespace {

#define DVRLAB_INLINE inline __attribute__((always_inline))

typedef double four __attribute__((vector_size(32)));
typedef float four_floats __attribute__((vector_size(16)));

// By reference: without AVX such a vector has no register to be returned in.
DVRLAB_INLINE void load(four& r, const double* p) { __builtin_memcpy(&r, p, sizeof r); }
DVRLAB_INLINE void store(double* p, const four& a) { __builtin_memcpy(p, &a, sizeof a); }
DVRLAB_INLINE void store(float* p, const four& a) {
  const four_floats r = __builtin_convertvector(a, four_floats);
  __builtin_memcpy(p, &r, sizeof r);
}

/// Gauss-Legendre on [0, 1]: exact to the degree 2 points - 1.
struct Gauss {
  int points;
  double x[4], weight[4];
};
constexpr Gauss gauss[] = {{1, {0.5}, {1}},
                           {2, {0.21132486540518712, 0.78867513459481288}, {0.5, 0.5}},
                           {3,
                            {0.11270166537925831, 0.5, 0.88729833462074169},
                            {0.27777777777777778, 0.44444444444444444, 0.27777777777777778}},
                           {4,
                            {0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
                            {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693}}};

/// What a bin adds to the moments of one group: G is its mean, y the depths and place the distances of the points.
template <int N, int P, int points>
DVRLAB_INLINE void add_bin(four* sum, const four& G, const four* y, const double* place) {
  constexpr const Gauss& rule = gauss[points - 1];
  four weighted[points];
#pragma GCC unroll 4
  for (int n = 0; n < points; ++n) weighted[n] = G * rule.weight[n];
#pragma GCC unroll 4
  for (int i = 0; i < N; ++i) {
    four term[points];
#pragma GCC unroll 4
    for (int n = 0; n < points; ++n) term[n] = weighted[n];
#pragma GCC unroll 4
    for (int l = 0; l < P; ++l) {
      four all = term[0];
#pragma GCC unroll 4
      for (int n = 1; n < points; ++n) all += term[n];
      sum[i * P + l] += all;
#pragma GCC unroll 4
      for (int n = 0; n < points && l + 1 < P; ++n) term[n] *= place[n];
    }
#pragma GCC unroll 4
    for (int n = 0; n < points && i + 1 < N; ++n) weighted[n] *= y[n];
  }
}

/// The same without places: the means of a power of a linear depth about its middle a, with s = tau^2 / 12.
template <int N>
DVRLAB_INLINE void add_bin(four* sum, const four& G, const four& depth, const four& tau) {
  const four a = depth + tau * 0.5, Ga = G * a, square = a * a, s = tau * tau * (1.0 / 12);
  sum[0] += G;
  if (N > 1) sum[1] += Ga;
  if (N > 2) sum[2] += G * (square + s);
  if (N > 3) sum[3] += Ga * (square + s * 3.0);
}

/// One half of a block: `length` bins from `first` on in steps of `way`, away from the middle. `grey`: one extinction.
/// Sums stay in registers: the groups are taken one after the other.
template <class T, int N, int P, bool grey>
DVRLAB_INLINE void fill_half(const BinMedium& bins, int first, int way, int length, double unit, T* level) {
  constexpr int moments = N * P, points = (N + P) / 2;
  constexpr const Gauss& rule = gauss[points - 1];
  const auto [r, g, b] = bins.extinction_at;
  for (int q = 0; q < bins.groups; ++q) {
    four sum[moments] = {}, depth{};
    for (int s = 0; s < length; ++s) {
      const int j = first + way * s;
      T* to = level + 4 * (static_cast<std::ptrdiff_t>(j) * bins.groups + q) * moments;
#pragma GCC unroll 16
      for (int k = 0; k < moments; ++k) store(to + 4 * k, sum[k]);
      const double* mean = bins.bin(j);
      const four tau = grey ? four{} + mean[r] : four{mean[r], mean[g], mean[b], mean[r]};
      four G, y[points];
      load(G, mean + 4 * q);
      if constexpr (P == 1) {
        add_bin<N>(sum, G, depth, tau);
        depth += tau;
        continue;
      }
      double place[points];
#pragma GCC unroll 4
      for (int n = 0; n < points; ++n) {
        y[n] = depth + tau * rule.x[n];
        place[n] = (s + rule.x[n]) * unit;
      }
      depth += tau;
      add_bin<N, P, points>(sum, G, y, place);
    }
  }
}

template <class T, int N, int P, bool grey>
DVRLAB_WIDE void fill(const BinMedium& bins, int levels, T* table) {
  const std::ptrdiff_t row = 4 * static_cast<std::ptrdiff_t>(bins.count) * bins.groups * N * P;
  for (int k = 1; k <= levels; ++k) {
    T* level = table + (k - 1) * row;
    const int half = 1 << k;
    for (int middle = half; middle - half < bins.count; middle += 2 * half) {
      // Below the middle from the highest bin that there is; entries beside missing bins are never asked for.
      const int top = std::min(middle, bins.count);
      fill_half<T, N, P, grey>(bins, top - 1, -1, top - (middle - half), 1.0 / half, level);
      fill_half<T, N, P, grey>(bins, middle, 1, std::clamp(bins.count - middle, 0, half), 1.0 / half, level);
    }
  }
}

template <class T>
void fill_any(const BinMedium& bins, int levels, int orders, int places, T* table) {
  const auto with_places = [&](auto order) {
    constexpr int N = decltype(order)::value;
    const bool grey = bins.extinction_at[1] == bins.extinction_at[0];
    const auto with = [&](auto place) {
      constexpr int P = decltype(place)::value;
      if (grey)
        fill<T, N, P, true>(bins, levels, table);
      else
        fill<T, N, P, false>(bins, levels, table);
    };
    if (places == 1)
      with(std::integral_constant<int, 1>());
    else if (places == 2)
      with(std::integral_constant<int, 2>());
    else
      with(std::integral_constant<int, 4>());
  };
  switch (orders) {
    case 1:
      return with_places(std::integral_constant<int, 1>());
    case 2:
      return with_places(std::integral_constant<int, 2>());
    case 3:
      return with_places(std::integral_constant<int, 3>());
    case 4:
      return with_places(std::integral_constant<int, 4>());
    default:
      throw std::logic_error("moment tables go to order 4");
  }
}

}  // namespace

int levels_of(int bins) { return std::bit_width(static_cast<unsigned>(bins + 1)) - 1; }

MomentTable moment_table(const BinMedium& bins, int orders, int places, bool fp64) {
  MomentTable t;
  t.levels = levels_of(bins.count - 2);
  t.entries = static_cast<std::uint64_t>(t.levels) * static_cast<std::uint64_t>(bins.count) *
              static_cast<std::uint64_t>(bins.groups * orders * places);
  if (fp64) {
    t.values = std::make_shared_for_overwrite<double[]>(4 * t.entries);
    fill_any(bins, t.levels, orders, places, t.values.get());
  } else {
    t.rounded = std::make_shared_for_overwrite<float[]>(4 * t.entries);
    fill_any(bins, t.levels, orders, places, t.rounded.get());
  }
  return t;
}

}  // namespace dvrlab::power_series
