// The contractive slide (docs/math, B5) over one block of consecutive m, in one direction.
//
// Lane l of a pack is the table's diagonal m0 + l. A step of the slide moves every lane's window of m cells by one: the
// front cell enters, the back cell leaves. All lanes share the front cell, row `row`; the back cells are row + m, so
// they lie on a diagonal of the arrays [cell][lane] of cell_arrays.h. The descending direction is the ascending one of
// the mirrored cells (table_layout.h), so there is one slide.
#pragma once

#include "plugins/estimator/preintegrated/cell_arrays.h"
#include "plugins/estimator/preintegrated/table_layout.h"

namespace dvr {

using dvrlab::preintegrated::row_start;
constexpr int most_columns = DVR_TABLE_MOST_COLUMNS;

/// Lane l: the sum over the cells from .. to + l - 1.
DVR_INLINE vd sum_to(const dvr_table_prefix& p, intptr_t from, intptr_t to) {
  if (p.hi == nullptr) return all(0.0);
  return (load(p.hi + to) - all(p.hi[from])) + (load(p.lo + to) - all(p.lo[from]));
}

/// What the cell arrays of one direction look like to the slide: cell k of the side is k or n - 2 - k in memory.
struct View {
  const dvr_table_job& job;
  const dvr_table_side& side;
  const Scratch& scratch;
  int direction;
  DVR_INLINE intptr_t front(int e, intptr_t k) const { return scratch.at(e, direction == 0 ? k : job.n - 2 - k); }
  /// Lane l: cell k + l.
  DVR_INLINE vd diagonal(const double* array, int e, intptr_t k) const {
    const intptr_t step = direction == 0 ? lanes : -lanes;
    return load_strided(array + front(e, k), step + 1);
  }
};

/// Where the value of a channel stands in the values of a step: 0, then of the columns C, D / m, D2 / m^2 and D3 / m^3,
/// then T.
inline void find_slots(const dvr_table_job& j, int* slot) {
  for (int k = 0; k < 4 * j.groups; ++k) {
    const int index = j.channel_index[k];
    switch (j.channel_kind[k]) {
      case DVR_TABLE_TOTAL:
        slot[k] = 1 + index;
        break;
      case DVR_TABLE_BACK:
        slot[k] = 1 + j.columns + index;
        break;
      case DVR_TABLE_SECOND:
        slot[k] = 1 + 2 * j.columns + index;
        break;
      case DVR_TABLE_THIRD:
        slot[k] = 1 + 3 * j.columns + index;
        break;
      case DVR_TABLE_TRANSMITTANCE:
        slot[k] = 1 + 4 * j.columns + index;
        break;
      default:
        slot[k] = 0;
    }
  }
}

/// Room for the values of a step.
constexpr int most_values = 1 + 4 * most_columns + 3;

/// The state of a slide: C of every column and its moments D, D2, D3 of the position in cells from the front.
struct State {
  vd C[most_columns], D[most_columns], D2[most_columns], D3[most_columns];
};

/// E = extinction channels, N = columns of a table without weights; 0 = as the job says.
template <int E, int N, bool ratio>
struct Slide {
  const dvr_table_job& j;
  const Diagonals& d;
  const View& v;
  DVR_INLINE int extinctions() const { return E > 0 ? E : j.extinctions; }
  DVR_INLINE int columns() const { return N > 0 ? N : j.columns; }
  DVR_INLINE bool weighted(int c) const { return N > 0 ? false : j.moments[c] != 0; }
  DVR_INLINE bool cubic(int c) const { return N > 0 ? false : j.moments[c] > 1; }
  DVR_INLINE int extinction_of(int c) const { return E == 1 ? 0 : j.extinction_of[c]; }

  DVR_INLINE vd source(int c, intptr_t k) const {
    return d.h_m * all(v.side.length_source[c][k]) + all(v.side.surface_source[c][k]);
  }
  DVR_INLINE vd source_diagonal(int c, intptr_t k) const {
    return d.h_m * load(v.side.length_source[c] + k) + load(v.side.surface_source[c] + k);
  }
  DVR_INLINE const double* dirac(const double* light, int q, int c) const {
    return light + (intptr_t(q) * j.columns + c) * lanes;
  }
  /// The Diracs' light of the cells k + l.
  DVR_INLINE vd dirac_diagonal(const double* light, int c, intptr_t k) const {
    double r[lanes];
    for (int l = 0; l < lanes; ++l) {
      const int q = v.side.dirac_cell[k + l];
      r[l] = q < 0 ? 0.0 : dirac(light, q, c)[l];
    }
    return load(r);
  }

  /// Windows of the rows below `top`, by inserting their cells from the back to the front (B4).
  void fill(State& s, int top) const {
    const int back = top + d.most < j.n - 2 ? top + d.most : j.n - 2;
    for (int c = 0; c < columns(); ++c) s.C[c] = s.D[c] = s.D2[c] = s.D3[c] = all(0.0);
    for (int k = back; k > top; --k) {
      const vm inside = all(k - top - 0.5) < d.m;
      const int q = v.side.dirac_cell[k];
      for (int c = 0; c < columns(); ++c) {
        const intptr_t i = v.front(extinction_of(c), k);
        const vd t = load(v.scratch.t + i), G = source(c, k);
        vd in = G * load(v.scratch.phi + i);
        if (q >= 0) in = in + load(dirac(v.scratch.dirac_total, q, c));
        if (cubic(c)) {
          vd second = G * load(v.scratch.psi2 + i), third = G * load(v.scratch.psi3 + i);
          if (q >= 0) {
            second = second + load(dirac(v.scratch.dirac_second, q, c));
            third = third + load(dirac(v.scratch.dirac_third, q, c));
          }
          third = third + t * (s.D3[c] + all(3.0) * (s.D2[c] + s.D[c]) + s.C[c]);
          second = second + t * (s.D2[c] + all(2.0) * s.D[c] + s.C[c]);
          s.D3[c] = select(inside, third, s.D3[c]);
          s.D2[c] = select(inside, second, s.D2[c]);
        }
        if (weighted(c)) {
          vd moment = G * load(v.scratch.psi + i);
          if (q >= 0) moment = moment + load(dirac(v.scratch.dirac_back, q, c));
          s.D[c] = select(inside, moment + t * (s.D[c] + s.C[c]), s.D[c]);
        }
        s.C[c] = select(inside, in + t * s.C[c], s.C[c]);
      }
    }
  }

  /// Row `row` from the row below it (B5). Fills the values that find_slots numbers.
  DVR_INLINE void step(State& s, intptr_t row, vd* value) const {
    const intptr_t back = row + d.m0;
    const int q = v.side.dirac_cell[row];
    // What stays without light is dark to the last bit: no rounding of bright cells that left.
    const vm lit = all(v.side.active[row + 1] + 0.5) < load(v.side.active + back);
    const bool near = v.side.dirac_near[back] != 0;
    vd t[3], R[3], phi[3], phi_back[3], psi[3], psi_back[3];
    for (int e = 0; e < extinctions(); ++e) {
      // The cells that stay: row + 1 .. row + m - 1. Rounding may leave an empty range a little below 0.
      const vd stay =
          d.h_m * sum_to(v.side.length_depth[e], row + 1, back) + sum_to(v.side.surface_depth[e], row + 1, back);
      R[e] = exp_minus(at_least(stay, 0.0));
      const intptr_t i = v.front(e, row);
      t[e] = load(v.scratch.t + i);
      phi[e] = load(v.scratch.phi + i);
      phi_back[e] = v.diagonal(v.scratch.phi, e, back);
      if (N == 0 && any_weight) {
        psi[e] = load(v.scratch.psi + i);
        psi_back[e] = v.diagonal(v.scratch.psi, e, back);
      }
      value[1 + 4 * columns() + e] = t[e] * R[e];
    }
    for (int c = 0; c < columns(); ++c) {
      const int e = extinction_of(c);
      const vd G = source(c, row), G_back = source_diagonal(c, back);
      vd in = G * phi[e], out = G_back * phi_back[e];
      if (__builtin_expect(q >= 0, 0)) in = in + load(dirac(v.scratch.dirac_total, q, c));
      if (__builtin_expect(near, 0)) out = out + dirac_diagonal(v.scratch.dirac_total, c, back);
      // What is left cannot be negative: the clamp keeps the rounding error of a bright cell that left out of a dark
      // rest.
      const vd rest = select(lit, at_least(s.C[c] - R[e] * out, 0.0), all(0.0));
      s.C[c] = in + t[e] * rest;
      value[1 + c] = s.C[c];
      if (!weighted(c)) continue;
      vd moment = G * psi[e], moment_back = G_back * psi_back[e];
      if (__builtin_expect(q >= 0, 0)) moment = moment + load(dirac(v.scratch.dirac_back, q, c));
      if (__builtin_expect(near, 0)) moment_back = moment_back + dirac_diagonal(v.scratch.dirac_back, c, back);
      const vd last = d.m - all(1.0);  // the front of the back cell, in cells
      const vd rest_moment = select(lit, at_least(s.D[c] - R[e] * (last * out + moment_back), 0.0), all(0.0));
      if (cubic(c)) {
        const intptr_t i = v.front(e, row);
        vd second = G * load(v.scratch.psi2 + i), third = G * load(v.scratch.psi3 + i);
        vd second_back = G_back * v.diagonal(v.scratch.psi2, e, back);
        vd third_back = G_back * v.diagonal(v.scratch.psi3, e, back);
        if (__builtin_expect(q >= 0, 0)) {
          second = second + load(dirac(v.scratch.dirac_second, q, c));
          third = third + load(dirac(v.scratch.dirac_third, q, c));
        }
        if (__builtin_expect(near, 0)) {
          second_back = second_back + dirac_diagonal(v.scratch.dirac_second, c, back);
          third_back = third_back + dirac_diagonal(v.scratch.dirac_third, c, back);
        }
        const vd rest_second =
            select(lit, at_least(s.D2[c] - R[e] * (last * (last * out + all(2.0) * moment_back) + second_back), 0.0),
                   all(0.0));
        const vd back_third =
            last * (last * (last * out + all(3.0) * moment_back) + all(3.0) * second_back) + third_back;
        const vd rest_third = select(lit, at_least(s.D3[c] - R[e] * back_third, 0.0), all(0.0));
        s.D3[c] = third + t[e] * (rest_third + all(3.0) * (rest_second + rest_moment) + rest);
        s.D2[c] = second + t[e] * (rest_second + all(2.0) * rest_moment + rest);
        value[1 + 2 * columns() + c] = s.D2[c] * d.inverse * d.inverse;
        value[1 + 3 * columns() + c] = s.D3[c] * d.inverse * d.inverse * d.inverse;
      }
      s.D[c] = moment + t[e] * (rest_moment + rest);
      value[1 + columns() + c] = s.D[c] * d.inverse;
    }
    if (ratio) divide(row, value);
  }

  /// C and B over the approximate integral (B2) of the same cells.
  DVR_INLINE void divide(intptr_t row, vd* value) const {
    const intptr_t end = row + d.m0;
    vd phi[3], middle[3], middle2[3], middle3[3];
    for (int e = 0; e < extinctions(); ++e) {
      const vd Q =
          at_least(d.h_m * sum_to(v.side.length_depth[e], row, end) + sum_to(v.side.surface_depth[e], row, end), 0.0);
      vd t, opacity;
      exp_minus(Q, t, opacity);
      phi[e] = phi1_of(Q, opacity);
      if (!any_weight) continue;
      const vd psi = psi_of(Q, t, phi[e]);
      middle[e] = psi / phi[e];
      if (!any_curve) continue;
      higher_psi_of(Q, t, psi, middle2[e], middle3[e]);
      middle2[e] = middle2[e] / phi[e];
      middle3[e] = middle3[e] / phi[e];
    }
    for (int c = 0; c < columns(); ++c) {
      const int e = extinction_of(c);
      const vd G = d.h_m * sum_to(v.side.length_sum[c], row, end) + sum_to(v.side.surface_sum[c], row, end);
      // (C + even) / (C_approx + even) with even = noise^2 / (noise + C): where C and C_approx are both far below the
      // noise the ratio is 1, where C is above it C / C_approx. One division.
      const vd noise = all(j.ratio_noise[c]), C = value[1 + c], more = noise + C, square = noise * noise;
      const vd scale = all(1.0) / (at_least(G, 0.0) * phi[e] * more + square);
      value[1 + c] = (C * more + square) * scale;
      if (weighted(c)) value[1 + columns() + c] = (value[1 + columns() + c] * more + square * middle[e]) * scale;
      if (!cubic(c)) continue;
      value[1 + 2 * columns() + c] = (value[1 + 2 * columns() + c] * more + square * middle2[e]) * scale;
      value[1 + 3 * columns() + c] = (value[1 + 3 * columns() + c] * more + square * middle3[e]) * scale;
    }
  }

  /// The rows top .. bottom, downwards.
  void run(int top, int bottom) {
    any_weight = N == 0 && any_weighted(j);
    any_curve = N == 0 && any_cubic(j);
    State s;
    fill(s, top);
    int slot[DVR_TABLE_MOST_CHANNELS];
    find_slots(j, slot);
    vd value[most_values];
    value[0] = all(0.0);
    const bool stream = j.stream != 0;
    for (int row = top; row >= bottom; --row) {
      step(s, row, value);
      const int valid = j.n - row - d.m0;
      for (int g = 0; g < j.groups; ++g) {
        float* to = v.side.out[g] + (row_start(j.n, row) + d.m0) * 4;
        const vd &a = value[slot[4 * g]], &b = value[slot[4 * g + 1]], &c = value[slot[4 * g + 2]],
                 &e = value[slot[4 * g + 3]];
        if (__builtin_expect(valid >= lanes, 1)) {
          store_channels(to, a, b, c, e, stream);
        } else {  // the row ends in this pack; its padding is 0
          alignas(64) float whole[4 * lanes];
          store_channels(whole, a, b, c, e, false);
          const int padded = (valid + 3) / 4 * 4;
          for (int k = 0; k < 4 * padded; ++k) to[k] = k < 4 * valid ? whole[k] : 0.0f;
        }
      }
    }
  }
  bool any_weight = false, any_curve = false;
};

/// m = 0: a segment of one value, of which only the length terms are left.
inline void diagonal(const dvr_table_job& j, const dvr_table_side& side) {
  for (int i = 0; i < j.n; i += lanes) {
    double value[most_values][lanes];
    store(value[0], all(0.0));
    for (int e = 0; e < j.extinctions; ++e) {
      const vd q = all(j.h) * load(side.at_extinction[e] + i);
      vd t, opacity;
      exp_minus(q, t, opacity);
      const vd phi = phi1_of(q, opacity), psi = psi_of(q, t, phi);
      store(value[1 + 4 * j.columns + e], t);
      vd second, third;
      higher_psi_of(q, t, psi, second, third);
      for (int c = 0; c < j.columns; ++c) {
        if (j.extinction_of[c] != e) continue;
        const vd G = all(j.h) * load(side.at_source[c] + i);
        store(value[1 + c], j.ratio ? all(1.0) : G * phi);
        store(value[1 + j.columns + c], j.ratio ? psi / phi : G * psi);
        store(value[1 + 2 * j.columns + c], j.ratio ? second / phi : G * second);
        store(value[1 + 3 * j.columns + c], j.ratio ? third / phi : G * third);
      }
    }
    int slot[DVR_TABLE_MOST_CHANNELS];
    find_slots(j, slot);
    for (int l = 0; l < lanes && i + l < j.n; ++l) {
      const int row = i + l;
      for (int k = 0; k < 4 * j.groups; ++k)
        side.out[k / 4][row_start(j.n, row) * 4 + k % 4] = float(value[slot[k]][l]);
    }
  }
  for (int g = 0; g < j.groups; ++g)  // the shortest row has no other entry: its padding is written here
    for (int k = 4; k < 16; ++k) side.out[g][row_start(j.n, j.n - 1) * 4 + k] = 0.0f;
}

}  // namespace dvr
