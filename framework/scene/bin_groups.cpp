#include "framework/scene/bin_groups.h"

#include <algorithm>
#include <vector>

#include "framework/interfaces/wide.h"
#include "framework/scene/bin_pieces.h"

namespace dvrlab {
namespace {

/// The coefficients of every interval: [interval][power of t][group][4].
std::vector<double> group_polynomials(const Medium& medium, const MediumLayout& layout) {
  const auto row = static_cast<std::size_t>(4 * layout.count());
  std::vector<double> r(3 * row * medium.interval.size());
  double* to = r.data();
  for (const MediumInterval& i : medium.interval) {
    for (std::size_t power = 0; power < 3; ++power, to += row) {
      std::array<double, medium_columns> column;
      for (std::size_t c = 0; c < medium_columns; ++c) column[c] = i.c[c][power];
      layout.write(column, to);
    }
  }
  return r;
}

double mean_of(const std::array<double, 3>& p, double a, double b) {
  return p[0] + p[1] * (a + b) / 2 + p[2] * (a * a + a * b + b * b) / 3;
}

/// Mean of the polynomial times s, s from -1 to 1 over the piece.
double slope_of(const std::array<double, 3>& p, double a, double b) {
  const double m = (a + b) / 2, h = (b - a) / 2;  // t = m + h s; mean of s^2 is 1/3, odd powers vanish
  return (p[1] * h + 2 * p[2] * m * h) / 3;
}

void add_barycentre(const Medium& medium, BinMedium& b) {
  const int group = b.groups - 1;
  const auto tau_s = [](int c) { return static_cast<std::size_t>(column(Term::tau_s, c)); };
  const double width = (b.hi - b.lo) / (b.count - 2);
  for (int j = 0; j < b.count; ++j) std::fill_n(b.bin(j) + 4 * group, 4, 0.0);
  for_each_piece(medium, b.lo, b.hi, b.count - 2, [&](int bin, const Piece& p) {
    double* to = b.bin(bin + 1) + 4 * group;
    const double share = (p.v1 - p.v0) / width, centre = ((p.v0 + p.v1) / 2 - b.lo) / width;
    for (int c = 0; c < 3; ++c) {
      const auto& tau = medium.interval[p.interval].c[tau_s(c)];
      const double mean = share / 3 * mean_of(tau, p.t0, p.t1);
      to[0] += centre * mean + share / 2 * share / 3 * slope_of(tau, p.t0, p.t1);
      to[1] += mean;
    }
  });
  for (const int j : {0, b.count - 1}) {
    const auto outside = j == 0 ? medium.at(b.lo, true) : medium.at(b.hi);
    double* to = b.bin(j) + 4 * group;
    for (int c = 0; c < 3; ++c) to[1] += outside[tau_s(c)] / 3;
    to[0] = to[1] * (j - 0.5);
  }
}

typedef double four __attribute__((vector_size(32)));

/// All bins inside the range. By the widest instructions of the machine; the numbers are the same.
DVRLAB_WIDE void fill(const Medium& medium, const double* polynomials, int groups, BinMedium& r) {
  const int bins = r.count - 2;
  const double inverse_width = bins / (r.hi - r.lo);
  for_each_piece(
      medium, r.lo, r.hi, bins, [&](int bin, const Piece& p) __attribute__((always_inline)) {
        const double share = (p.v1 - p.v0) * inverse_width, t = share * (p.t0 + p.t1) / 2,
                     tt = share * (p.t0 * p.t0 + p.t0 * p.t1 + p.t1 * p.t1) / 3;
        const double* from = polynomials + 12 * static_cast<std::ptrdiff_t>(p.interval) * groups;
        double* to = r.bin(bin + 1);
        for (int g = 0; g < groups; ++g, from += 4, to += 4) {
          four c0, c1, c2, sum{};
          __builtin_memcpy(&c0, from, sizeof c0);
          __builtin_memcpy(&c1, from + 4 * groups, sizeof c1);
          __builtin_memcpy(&c2, from + 8 * groups, sizeof c2);
          if (!p.first) __builtin_memcpy(&sum, to, sizeof sum);
          sum += c0 * share + c1 * t + c2 * tt;
          __builtin_memcpy(to, &sum, sizeof sum);
        }
      });
}

}  // namespace

BinMedium bin_groups(const Medium& medium, const MediumLayout& layout, double lo, double hi, int bins,
                     bool barycentre) {
  BinMedium r;
  r.count = bins + 2;
  r.groups = layout.count() + (barycentre ? 1 : 0);
  r.lo = lo;
  r.hi = hi;
  for (int c = 0; c < 3; ++c) r.extinction_at[static_cast<std::size_t>(c)] = layout.extinction_at(c);
  r.mean = std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(4 * r.groups) *
                                                    static_cast<std::size_t>(r.count));
  if (medium.interval.empty()) std::fill_n(r.mean.get(), 4 * r.groups * r.count, 0.0);
  const std::vector<double> polynomials = group_polynomials(medium, layout);
  fill(medium, polynomials.data(), layout.count(), r);
  layout.write(medium.at(lo, true), r.bin(0));
  layout.write(medium.at(hi), r.bin(r.count - 1));
  if (barycentre) add_barycentre(medium, r);
  return r;
}

}  // namespace dvrlab
