#include "bench/support/scalar_table.h"

#include <algorithm>
#include <cmath>

#include "plugins/estimator/preintegrated/table_layout.h"

namespace dvrlab::bench {

namespace {
using preintegrated::Cells;
using preintegrated::row_start;
using preintegrated::table_entries;

struct Cell {
  double t, c[3];
};

class Build {
 public:
  Build(const Cells& cells, double h)
      : cells_(cells), h_(h), n_(cells.grid.n), cell_(std::size_t(n_ - 1)), depth_(std::size_t(n_)) {
    for (int ch = 0; ch < 3; ++ch) {
      source_[ch] = cells.integral[std::size_t(column(Term::E, ch))];
      const auto& P = cells.integral[std::size_t(column(Term::P, ch))];
      for (std::size_t k = 0; k < source_[ch].size(); ++k) source_[ch][k] += P[k];
    }
  }

  void diagonals(int m, ScalarTable& table) {
    const auto& tau_l = cells_.integral[std::size_t(column(Term::tau_l, 0))];
    const auto& tau_s = cells_.integral[std::size_t(column(Term::tau_s, 0))];
    const double h_m = h_ / m;
    double depth = 0;
    for (int k = 0; k < n_ - 1; ++k) {
      const double q = h_m * tau_l[std::size_t(k)] + tau_s[std::size_t(k)];
      const double e = std::expm1(-q), phi = q > 0 ? -e / q : 1;
      Cell& c = cell_[std::size_t(k)];
      c.t = 1 + e;
      for (int ch = 0; ch < 3; ++ch) c.c[ch] = h_m * source_[ch][std::size_t(k)] * phi;
      depth_[std::size_t(k)] = depth;
      depth += q;
    }
    depth_[std::size_t(n_ - 1)] = depth;
    slide<0>(m, table.entry[0].data());
    slide<1>(m, table.entry[1].data());
  }

 private:
  // The mirrored cell of a descending row.
  template <int direction>
  std::size_t at(int k) const {
    return std::size_t(direction == 0 ? k : n_ - 2 - k);
  }
  template <int direction>
  double depth(int k) const {
    return direction == 0 ? depth_[std::size_t(k)] : -depth_[std::size_t(n_ - 1 - k)];
  }

  template <int direction>
  void slide(int m, float* out) {
    double C[3] = {0, 0, 0}, T = 1;
    for (int k = n_ - 2; k >= n_ - 1 - m; --k) {
      const Cell& c = cell_[at<direction>(k)];
      for (int ch = 0; ch < 3; ++ch) C[ch] = c.c[ch] + c.t * C[ch];
      T *= c.t;
    }
    for (int i = n_ - 1 - m;; --i) {
      float* entry = out + (row_start(n_, i) + m) * 4;
      for (int ch = 0; ch < 3; ++ch) entry[ch] = static_cast<float>(C[ch]);
      entry[3] = static_cast<float>(T);
      if (i == 0) return;
      const Cell &front = cell_[at<direction>(i - 1)], &back = cell_[at<direction>(i - 1 + m)];
      const double R = std::exp(depth<direction>(i) - depth<direction>(i - 1 + m));
      for (int ch = 0; ch < 3; ++ch) C[ch] = front.c[ch] + front.t * (C[ch] - R * back.c[ch]);
      T = front.t * R;
    }
  }

  const Cells& cells_;
  double h_;
  int n_;
  std::vector<double> source_[3];
  std::vector<Cell> cell_;
  std::vector<double> depth_;
};
}  // namespace

void build_scalar(const Cells& cells, double h, ScalarTable& table) {
  const int n = cells.grid.n;
  for (auto& e : table.entry) e.resize(std::size_t(table_entries(n)) * 4);
  Build build(cells, h);
  for (int m = 1; m < n; ++m) build.diagonals(m, table);
  for (int direction = 0; direction < 2; ++direction) {
    for (int row = 0; row < n; ++row) {
      const std::size_t i = std::size_t(direction == 0 ? row : n - 1 - row);
      float* entry = table.entry[direction].data() + row_start(n, row) * 4;
      const double q = h * cells.at_value[std::size_t(column(Term::tau_l, 0))][i];
      const double phi = q > 0 ? -std::expm1(-q) / q : 1;
      for (int ch = 0; ch < 3; ++ch)
        entry[ch] = static_cast<float>(h * phi *
                                       (cells.at_value[std::size_t(column(Term::E, ch))][i] +
                                        cells.at_value[std::size_t(column(Term::P, ch))][i]));
      entry[3] = static_cast<float>(std::exp(-q));
    }
  }
}

}  // namespace dvrlab::bench
