// The pieces of the bins of a regular grid in which a medium's columns are polynomials.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "framework/interfaces/medium.h"

namespace dvrlab {

/// A part of a bin in which the columns are polynomials of t.
struct Piece {
  std::size_t interval;  // of the medium
  double t0, t1;         // the polynomials' coordinate at both ends
  double v0, v1;         // values
  bool first;            // of its bin
};

/// Calls visit(bin, piece) for every piece of every bin of [lo, hi], both in ascending order.
template <class Visit>
void for_each_piece(const Medium& medium, double lo, double hi, int bins, Visit visit) {
  if (medium.interval.empty()) return;
  const auto& all = medium.interval;
  const double width = (hi - lo) / bins;
  std::size_t k = 0;
  double scale = 1.0 / (all[0].v1 - all[0].v0);
  for (int bin = 0; bin < bins; ++bin) {
    const double a = lo + width * bin, b = bin + 1 == bins ? hi : lo + width * (bin + 1);
    while (k + 1 < all.size() && all[k].v1 <= a) scale = 1.0 / (all[k + 1].v1 - all[k + 1].v0), ++k;
    if (a >= all[k].v0 && b <= all[k].v1) {  // most bins are one piece
      visit(bin, Piece{k, (a - all[k].v0) * scale, (b - all[k].v0) * scale, a, b, true});
      continue;
    }
    double v = a;
    for (std::size_t i = k; v < b; ++i) {
      const MediumInterval& m = all[i];
      const double end = i + 1 < all.size() ? std::min(b, std::max(m.v1, v)) : b;
      const auto t = [&](double x) { return std::clamp((x - m.v0) / (m.v1 - m.v0), 0.0, 1.0); };
      // Outside the first and last border the columns are constant: a piece that crosses the border is two.
      for (double border : {m.v0, m.v1}) {
        if (!(border > v && border < end)) continue;
        visit(bin, Piece{i, t(v), t(border), v, border, v == a});
        v = border;
      }
      if (end > v) visit(bin, Piece{i, t(v), t(end), v, end, v == a});
      v = end;
      if (i + 1 == all.size()) break;
    }
  }
}

}  // namespace dvrlab
