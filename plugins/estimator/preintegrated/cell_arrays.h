// What one thread of the table builder computes once per block of diagonals: the cells' t, phi1 and psi, per lane.
#pragma once

#include "plugins/estimator/preintegrated/lanes.h"
#include "plugins/estimator/preintegrated/table_module.h"

namespace dvr {

constexpr int pad = DVR_TABLE_PAD;
static_assert(pad >= lanes);

inline int most_moments(const dvr_table_job& j) {
  int most = 0;
  for (int s = 0; s < j.columns; ++s) most = j.moments[s] > most ? j.moments[s] : most;
  return most;
}
inline bool any_weighted(const dvr_table_job& j) { return most_moments(j) > 0; }
inline bool any_cubic(const dvr_table_job& j) { return most_moments(j) > 1; }

/// One thread's arrays. Cell k of extinction channel e begins at at(e, k).
struct Scratch {
  double *t, *phi, *psi;             // [extinction][cell][lane]
  double *psi2, *psi3;               // with u^2 and u^3 in psi's place
  double *dirac_total, *dirac_back;  // [Dirac cell][column][lane]: what the Diracs of a cell add to c and d
  double *dirac_second, *dirac_third;
  intptr_t cells;  // padded
  Scratch(const dvr_table_job& j, double* memory)
      : t(memory),
        phi(t + per_cell(j)),
        psi(phi + per_cell(j)),
        psi2(psi + (any_weighted(j) ? per_cell(j) : 0)),
        psi3(psi2 + (any_cubic(j) ? per_cell(j) : 0)),
        dirac_total(psi3 + (any_cubic(j) ? per_cell(j) : 0)),
        dirac_back(dirac_total + per_dirac(j)),
        dirac_second(dirac_back + per_dirac(j)),
        dirac_third(dirac_second + per_dirac(j)),
        cells(j.n + 2 * pad) {}
  static size_t doubles(const dvr_table_job& j) {
    return size_t((any_cubic(j) ? 5 : any_weighted(j) ? 3 : 2) * per_cell(j) + 4 * per_dirac(j));
  }
  DVR_INLINE intptr_t at(int e, intptr_t k) const { return (e * cells + k + pad) * lanes; }

 private:
  static intptr_t per_cell(const dvr_table_job& j) { return intptr_t(j.extinctions) * (j.n + 2 * pad) * lanes; }
  static intptr_t per_dirac(const dvr_table_job& j) { return intptr_t(j.dirac_cells) * j.columns * lanes; }
};

/// The block's diagonals: m, and per lane h / m and 1 / m (0 for m = 0, whose lane is overwritten by the diagonal).
struct Diagonals {
  int m0, most;  // most: the largest m of the block that the table has
  vd m, h_m, inverse;
  Diagonals(const dvr_table_job& j, int first)
      : m0(first), most(first + lanes - 1 < j.n - 1 ? first + lanes - 1 : j.n - 1) {
    double a[lanes], b[lanes], c[lanes];
    for (int l = 0; l < lanes; ++l) {
      a[l] = m0 + l;
      b[l] = m0 + l == 0 ? 0.0 : j.h / (m0 + l);
      c[l] = m0 + l == 0 ? 0.0 : 1.0 / (m0 + l);
    }
    m = load(a);
    h_m = load(b);
    inverse = load(c);
  }
};

/// t_k, phi1(q_k) and psi(q_k) of the homogeneous cells [first, last).
inline void evaluate(const dvr_table_job& j, const Diagonals& d, const Scratch& s, int first, int last) {
  const bool weighted = any_weighted(j), cubic = any_cubic(j);
  for (int e = 0; e < j.extinctions; ++e) {
    for (int k = first; k < last; ++k) {
      const vd q = d.h_m * all(j.length_extinction[e][k]) + all(j.surface_extinction[e][k]);
      vd t, opacity;
      exp_minus(q, t, opacity);
      const vd phi = phi1_of(q, opacity);
      store(s.t + s.at(e, k), t);
      store(s.phi + s.at(e, k), phi);
      if (!weighted) continue;
      const vd psi = psi_of(q, t, phi);
      store(s.psi + s.at(e, k), psi);
      if (!cubic) continue;
      vd second, third;
      higher_psi_of(q, t, psi, second, third);
      store(s.psi2 + s.at(e, k), second);
      store(s.psi3 + s.at(e, k), third);
    }
    for (int p = 0; p < pad; ++p) {
      for (int end = 0; end < 2; ++end) {  // behind the ends: empty
        const int k = end == 0 ? -1 - p : j.n - 1 + p;
        store(s.t + s.at(e, k), all(1.0));
        store(s.phi + s.at(e, k), all(1.0));
        if (weighted) store(s.psi + s.at(e, k), all(0.5));
        if (!cubic) continue;
        store(s.psi2 + s.at(e, k), all(1.0 / 3));
        store(s.psi3 + s.at(e, k), all(0.25));
      }
    }
  }
}

/// Cells with Diracs, as they are passed in the given direction: homogeneous parts between the Diracs, composed by
/// (B4). A homogeneous source scales c and d of all columns alike; the Diracs' own light is kept apart.
inline void evaluate_diracs(const dvr_table_job& j, const Diagonals& d, const Scratch& s, int direction, int first,
                            int last) {
  const bool weighted = any_weighted(j), cubic = any_cubic(j);
  for (int q = 0; q < j.dirac_cells; ++q) {
    const int cell = j.dirac_at[q];
    if (cell < first || cell >= last) continue;
    const int begin = j.dirac_first[q], count = j.dirac_first[q + 1] - begin;
    const intptr_t light = intptr_t(q) * j.columns * lanes;
    double* const sums[] = {s.dirac_total, s.dirac_back, s.dirac_second, s.dirac_third};
    for (double* sum : sums)
      for (int i = 0; i < j.columns * lanes; ++i) sum[light + i] = 0.0;
    for (int e = 0; e < j.extinctions; ++e) {
      const vd whole = d.h_m * all(j.length_extinction[e][cell]) + all(j.surface_extinction[e][cell]);
      vd T = all(1.0), phi = all(0.0), psi = all(0.0), psi2 = all(0.0), psi3 = all(0.0);
      double at = 0;
      const auto part = [&](double end) {
        const double length = end - at;
        const vd depth = whole * all(length);
        vd t, opacity;
        exp_minus(depth, t, opacity);
        const vd f = phi1_of(depth, opacity);
        phi = phi + T * all(length) * f;
        const vd moment = all(length) * psi_of(depth, t, f), share = T * all(length);
        psi = psi + share * (all(at) * f + moment);
        if (cubic) {
          vd second, third;
          higher_psi_of(depth, t, psi_of(depth, t, f), second, third);
          second = second * all(length * length);
          third = third * all(length * length * length);
          psi2 = psi2 + share * (all(at * at) * f + all(2 * at) * moment + second);
          psi3 = psi3 + share * (all(at * at * at) * f + all(3 * at * at) * moment + all(3 * at) * second + third);
        }
        T = T * t;
        at = end;
      };
      for (int i = 0; i < count; ++i) {
        const int k = direction == 0 ? begin + i : begin + count - 1 - i;
        const double u = direction == 0 ? j.dirac_u[k] : 1.0 - j.dirac_u[k];
        part(u);
        vd t, opacity;
        exp_minus(all(j.dirac_mu[e][k]), t, opacity);
        for (int c = 0; c < j.columns; ++c) {
          if (j.extinction_of[c] != e) continue;
          double* total = s.dirac_total + light + c * lanes;
          double* back = s.dirac_back + light + c * lanes;
          const vd seen = T * opacity * all(j.dirac_source[c][k]);
          store(total, load(total) + seen);
          store(back, load(back) + seen * all(u));
          double* second = s.dirac_second + light + c * lanes;
          double* third = s.dirac_third + light + c * lanes;
          store(second, load(second) + seen * all(u * u));
          store(third, load(third) + seen * all(u * u * u));
        }
        T = T * t;
      }
      part(1.0);
      store(s.t + s.at(e, cell), T);
      store(s.phi + s.at(e, cell), phi);
      if (weighted) store(s.psi + s.at(e, cell), psi);
      if (!cubic) continue;
      store(s.psi2 + s.at(e, cell), psi2);
      store(s.psi3 + s.at(e, cell), psi3);
    }
  }
}

}  // namespace dvr
