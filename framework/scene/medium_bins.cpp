#include "framework/scene/medium_bins.h"

#include <algorithm>

namespace dvrlab {
namespace {

/// A part of a bin in which the columns are polynomials of t.
struct Piece {
  const MediumInterval* interval;
  double t0, t1;  // the polynomials' coordinate at both ends
  double v0, v1;  // values
};

/// Calls visit(bin, piece) for every piece of every bin, both in ascending order.
template <class Visit>
void sweep(const Medium& medium, double lo, double hi, int bins, Visit visit) {
  if (medium.interval.empty()) return;
  const auto& all = medium.interval;
  std::size_t k = 0;
  for (int bin = 0; bin < bins; ++bin) {
    const double a = lo + (hi - lo) * bin / bins, b = lo + (hi - lo) * (bin + 1) / bins;
    while (k + 1 < all.size() && all[k].v1 <= a) ++k;
    double v = a;
    for (std::size_t i = k; v < b; ++i) {
      const MediumInterval& m = all[i];
      const double end = i + 1 < all.size() ? std::min(b, std::max(m.v1, v)) : b;
      const auto t = [&](double x) { return std::clamp((x - m.v0) / (m.v1 - m.v0), 0.0, 1.0); };
      // Outside the first and last border the columns are constant: a piece that crosses the border is two.
      for (double border : {m.v0, m.v1}) {
        if (!(border > v && border < end)) continue;
        visit(bin, Piece{&m, t(v), t(border), v, border});
        v = border;
      }
      if (end > v) visit(bin, Piece{&m, t(v), t(end), v, end});
      v = end;
      if (i + 1 == all.size()) break;
    }
  }
}

double mean_of(const std::array<double, 3>& p, double a, double b) {
  return p[0] + p[1] * (a + b) / 2 + p[2] * (a * a + a * b + b * b) / 3;
}

/// Mean of the polynomial times s, s from -1 to 1 over the piece.
double slope_of(const std::array<double, 3>& p, double a, double b) {
  const double m = (a + b) / 2, h = (b - a) / 2;  // t = m + h s; mean of s^2 is 1/3, odd powers vanish
  return (p[1] * h + 2 * p[2] * m * h) / 3;
}

}  // namespace

std::vector<MediumColumns> bin_means(const Medium& medium, double lo, double hi, int bins) {
  std::vector<MediumColumns> means(static_cast<std::size_t>(bins));
  const double width = (hi - lo) / bins;
  sweep(medium, lo, hi, bins, [&](int bin, const Piece& p) {
    MediumColumns& m = means[static_cast<std::size_t>(bin)];
    const double share = (p.v1 - p.v0) / width;
    for (std::size_t c = 0; c < medium_columns; ++c) m[c] += share * mean_of(p.interval->c[c], p.t0, p.t1);
  });
  return means;
}

std::vector<double> bin_surface_offsets(const Medium& medium, double lo, double hi, int bins) {
  std::vector<double> offsets(static_cast<std::size_t>(bins));
  const double width = (hi - lo) / bins;
  sweep(medium, lo, hi, bins, [&](int bin, const Piece& p) {
    const double share = (p.v1 - p.v0) / width;
    const double centre = ((p.v0 + p.v1) / 2 - lo) / width - (bin + 0.5), half = share / 2;
    for (int c = 0; c < 3; ++c) {
      const auto& tau = p.interval->c[static_cast<std::size_t>(column(Term::tau_s, c))];
      offsets[static_cast<std::size_t>(bin)] +=
          share / 3 * (centre * mean_of(tau, p.t0, p.t1) + half * slope_of(tau, p.t0, p.t1));
    }
  });
  return offsets;
}

}  // namespace dvrlab
