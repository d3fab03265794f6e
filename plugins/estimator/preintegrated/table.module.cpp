// One instruction set's part of the table builder: the contractive slide (docs/math, B5) over blocks of consecutive m.
//
// Lane l of a pack is the table's diagonal m0 + l. A step of the slide moves every lane's window of m cells by one: the
// front cell enters, the back cell leaves. All lanes share the front cell, row `row`; the back cells are row + m, so
// they lie on a diagonal of the arrays [cell][lane] that `evaluate` fills once per block. The descending direction is
// the ascending one of the mirrored cells (table_layout.h), so there is one slide.
#include "plugins/estimator/preintegrated/lanes.h"
#include "plugins/estimator/preintegrated/table_layout.h"
#include "plugins/estimator/preintegrated/table_module.h"

namespace {
using namespace dvr;
using dvrlab::preintegrated::row_start;

constexpr int pad = DVR_TABLE_PAD;
constexpr int most_columns = DVR_TABLE_MOST_COLUMNS;
static_assert(pad >= lanes);

/// Results below the least normal float are 0, on every instruction set alike; and no step waits for a denormal.
class FlushToZero {
 public:
  FlushToZero() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
  ~FlushToZero() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
};

bool any_weighted(const dvr_table_job& j) {
  for (int s = 0; s < j.columns; ++s)
    if (j.weighted[s]) return true;
  return false;
}

/// One thread's arrays. Cell k of extinction channel e begins at at(e, k).
struct Scratch {
  double *t, *phi, *psi;             // [extinction][cell][lane]
  double *dirac_total, *dirac_back;  // [Dirac cell][column][lane]: what the Diracs of a cell add to c and d
  intptr_t cells;                    // padded
  Scratch(const dvr_table_job& j, double* memory)
      : t(memory),
        phi(t + per_cell(j)),
        psi(phi + per_cell(j)),
        dirac_total(psi + (any_weighted(j) ? per_cell(j) : 0)),
        dirac_back(dirac_total + per_dirac(j)),
        cells(j.n + 2 * pad) {}
  static size_t doubles(const dvr_table_job& j) {
    return size_t((any_weighted(j) ? 3 : 2) * per_cell(j) + 2 * per_dirac(j));
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
void evaluate(const dvr_table_job& j, const Diagonals& d, const Scratch& s, int first, int last) {
  const bool weighted = any_weighted(j);
  for (int e = 0; e < j.extinctions; ++e) {
    for (int k = first; k < last; ++k) {
      const vd q = d.h_m * all(j.length_extinction[e][k]) + all(j.surface_extinction[e][k]);
      vd t, opacity;
      exp_minus(q, t, opacity);
      const vd phi = phi1_of(q, opacity);
      store(s.t + s.at(e, k), t);
      store(s.phi + s.at(e, k), phi);
      if (weighted) store(s.psi + s.at(e, k), psi_of(q, t, phi));
    }
    for (int p = 0; p < pad; ++p) {
      for (int end = 0; end < 2; ++end) {  // behind the ends: empty
        const int k = end == 0 ? -1 - p : j.n - 1 + p;
        store(s.t + s.at(e, k), all(1.0));
        store(s.phi + s.at(e, k), all(1.0));
        if (weighted) store(s.psi + s.at(e, k), all(0.5));
      }
    }
  }
}

/// Cells with Diracs, as they are passed in the given direction: homogeneous parts between the Diracs, composed by
/// (B4). A homogeneous source scales c and d of all columns alike; the Diracs' own light is kept apart.
void evaluate_diracs(const dvr_table_job& j, const Diagonals& d, const Scratch& s, int direction, int first, int last) {
  const bool weighted = any_weighted(j);
  for (int q = 0; q < j.dirac_cells; ++q) {
    const int cell = j.dirac_at[q];
    if (cell < first || cell >= last) continue;
    const int begin = j.dirac_first[q], count = j.dirac_first[q + 1] - begin;
    const intptr_t light = intptr_t(q) * j.columns * lanes;
    for (int i = 0; i < j.columns * lanes; ++i) s.dirac_total[light + i] = s.dirac_back[light + i] = 0.0;
    for (int e = 0; e < j.extinctions; ++e) {
      const vd whole = d.h_m * all(j.length_extinction[e][cell]) + all(j.surface_extinction[e][cell]);
      vd T = all(1.0), phi = all(0.0), psi = all(0.0);
      double at = 0;
      const auto part = [&](double end) {
        const double length = end - at;
        const vd depth = whole * all(length);
        vd t, opacity;
        exp_minus(depth, t, opacity);
        const vd f = phi1_of(depth, opacity);
        phi = phi + T * all(length) * f;
        psi = psi + T * all(length) * (all(at) * f + all(length) * psi_of(depth, t, f));
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
        }
        T = T * t;
      }
      part(1.0);
      store(s.t + s.at(e, cell), T);
      store(s.phi + s.at(e, cell), phi);
      if (weighted) store(s.psi + s.at(e, cell), psi);
    }
  }
}

/// The cells from .. to + l - 1.
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

/// Where the value of a channel stands in the values of a step: 0, C of the columns, D / m of the columns, T.
void find_slots(const dvr_table_job& j, int* slot) {
  for (int k = 0; k < 4 * j.groups; ++k) {
    const int index = j.channel_index[k];
    switch (j.channel_kind[k]) {
      case DVR_TABLE_TOTAL:
        slot[k] = 1 + index;
        break;
      case DVR_TABLE_BACK:
        slot[k] = 1 + j.columns + index;
        break;
      case DVR_TABLE_TRANSMITTANCE:
        slot[k] = 1 + 2 * j.columns + index;
        break;
      default:
        slot[k] = 0;
    }
  }
}

/// The state of a slide: C and D of every column (D in cells from the front).
struct State {
  vd C[most_columns], D[most_columns];
};

/// E = extinction channels, N = columns of a table without weights; 0 = as the job says.
template <int E, int N, bool ratio>
struct Slide {
  const dvr_table_job& j;
  const Diagonals& d;
  const View& v;
  DVR_INLINE int extinctions() const { return E > 0 ? E : j.extinctions; }
  DVR_INLINE int columns() const { return N > 0 ? N : j.columns; }
  DVR_INLINE bool weighted(int c) const { return N > 0 ? false : j.weighted[c] != 0; }
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
    for (int c = 0; c < columns(); ++c) s.C[c] = s.D[c] = all(0.0);
    for (int k = back; k > top; --k) {
      const vm inside = all(k - top - 0.5) < d.m;
      const int q = v.side.dirac_cell[k];
      for (int c = 0; c < columns(); ++c) {
        const intptr_t i = v.front(extinction_of(c), k);
        const vd t = load(v.scratch.t + i), G = source(c, k);
        vd in = G * load(v.scratch.phi + i);
        if (q >= 0) in = in + load(dirac(v.scratch.dirac_total, q, c));
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
      value[1 + 2 * columns() + e] = t[e] * R[e];
    }
    for (int c = 0; c < columns(); ++c) {
      const int e = extinction_of(c);
      const vd G = source(c, row), G_back = source_diagonal(c, back);
      vd in = G * phi[e], out = G_back * phi_back[e];
      if (__builtin_expect(q >= 0, 0)) in = in + load(dirac(v.scratch.dirac_total, q, c));
      if (__builtin_expect(near, 0)) out = out + dirac_diagonal(v.scratch.dirac_total, c, back);
      // What is left cannot be negative: the clamp keeps the rounding error of a bright cell that left out of a dark
      // rest.
      const vd rest = at_least(s.C[c] - R[e] * out, 0.0);
      s.C[c] = in + t[e] * rest;
      value[1 + c] = s.C[c];
      if (!weighted(c)) continue;
      vd moment = G * psi[e], moment_back = G_back * psi_back[e];
      if (__builtin_expect(q >= 0, 0)) moment = moment + load(dirac(v.scratch.dirac_back, q, c));
      if (__builtin_expect(near, 0)) moment_back = moment_back + dirac_diagonal(v.scratch.dirac_back, c, back);
      const vd rest_moment = at_least(s.D[c] - R[e] * ((d.m - all(1.0)) * out + moment_back), 0.0);
      s.D[c] = moment + t[e] * (rest_moment + rest);
      value[1 + columns() + c] = s.D[c] * d.inverse;
    }
    if (ratio) divide(row, value);
  }

  /// C and B over the approximate integral (B2) of the same cells.
  DVR_INLINE void divide(intptr_t row, vd* value) const {
    const intptr_t end = row + d.m0;
    vd phi[3], middle[3];
    for (int e = 0; e < extinctions(); ++e) {
      const vd Q =
          at_least(d.h_m * sum_to(v.side.length_depth[e], row, end) + sum_to(v.side.surface_depth[e], row, end), 0.0);
      vd t, opacity;
      exp_minus(Q, t, opacity);
      phi[e] = phi1_of(Q, opacity);
      if (any_weight) middle[e] = psi_of(Q, t, phi[e]) / phi[e];
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
    }
  }

  /// The rows top .. bottom, downwards.
  void run(int top, int bottom) {
    any_weight = N == 0 && any_weighted(j);
    State s;
    fill(s, top);
    int slot[DVR_TABLE_MOST_CHANNELS];
    find_slots(j, slot);
    vd value[1 + 2 * most_columns + 3];
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
  bool any_weight = false;
};

/// m = 0: a segment of one value, of which only the length terms are left.
void diagonal(const dvr_table_job& j, const dvr_table_side& side) {
  for (int i = 0; i < j.n; i += lanes) {
    double value[1 + 2 * most_columns + 3][lanes];
    store(value[0], all(0.0));
    for (int e = 0; e < j.extinctions; ++e) {
      const vd q = all(j.h) * load(side.at_extinction[e] + i);
      vd t, opacity;
      exp_minus(q, t, opacity);
      const vd phi = phi1_of(q, opacity), psi = psi_of(q, t, phi);
      store(value[1 + 2 * j.columns + e], t);
      for (int c = 0; c < j.columns; ++c) {
        if (j.extinction_of[c] != e) continue;
        const vd G = all(j.h) * load(side.at_source[c] + i);
        store(value[1 + c], j.ratio ? all(1.0) : G * phi);
        store(value[1 + j.columns + c], j.ratio ? psi / phi : G * psi);
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

template <int E, int N>
void slide(const dvr_table_job& j, const Diagonals& d, const View& v, int top, int bottom) {
  if (j.ratio)
    Slide<E, N, true>{j, d, v}.run(top, bottom);
  else
    Slide<E, N, false>{j, d, v}.run(top, bottom);
}

void block(const dvr_table_job* job, void* memory, int32_t m0, int32_t first, int32_t last) {
  const FlushToZero flush;
  const dvr_table_job& j = *job;
  const Scratch scratch(j, static_cast<double*>(memory));
  const Diagonals d(j, m0);
  // The rows of a side whose window meets the changed cells, and the cells that those windows and their start need.
  int top[2], bottom[2], begin = j.n - 1, end = 0;
  for (int s = 0; s < 2; ++s) {
    const int from = s == 0 ? first : j.n - 1 - last, to = s == 0 ? last : j.n - 1 - first;
    const int longest_row = j.n - 1 - (m0 > 1 ? m0 : 1);
    top[s] = to - 1 < longest_row ? to - 1 : longest_row;
    bottom[s] = from - d.most + 1 > 0 ? from - d.most + 1 : 0;
    if (top[s] < bottom[s]) continue;
    const int cell_end = top[s] + d.most + 1 < j.n - 1 ? top[s] + d.most + 1 : j.n - 1;
    const int a = s == 0 ? bottom[s] : j.n - 1 - cell_end, b = s == 0 ? cell_end : j.n - 1 - bottom[s];
    begin = a < begin ? a : begin;
    end = b > end ? b : end;
  }
  evaluate(j, d, scratch, begin, end);
  for (int s = 0; s < 2; ++s) {
    if (top[s] < bottom[s]) continue;
    evaluate_diracs(j, d, scratch, s, begin, end);
    const View view{j, j.side[s], scratch, s};
    if (j.extinctions == 1 && j.columns == 3 && !any_weighted(j))
      slide<1, 3>(j, d, view, top[s], bottom[s]);
    else
      slide<0, 0>(j, d, view, top[s], bottom[s]);
  }
  if (m0 == 0)
    for (const dvr_table_side& side : j.side) diagonal(j, side);
  _mm_sfence();
}

size_t scratch_bytes(const dvr_table_job* job) { return Scratch::doubles(*job) * sizeof(double); }

void functions(const double* x, int32_t count, double* t, double* opacity, double* phi1, double* psi) {
  const FlushToZero flush;
  for (int i = 0; i < count; i += lanes) {
    const int some = count - i < lanes ? count - i : lanes;
    double in[lanes] = {}, a[lanes], b[lanes], c[lanes], e[lanes];
    memcpy(in, x + i, size_t(some) * sizeof(double));
    vd vt, vo;
    exp_minus(load(in), vt, vo);
    const vd phi = phi1_of(load(in), vo);
    store(a, vt);
    store(b, vo);
    store(c, phi);
    store(e, psi_of(load(in), vt, phi));
    const auto copy = [&](double* to, const double* from) { memcpy(to + i, from, size_t(some) * sizeof(double)); };
    copy(t, a);
    copy(opacity, b);
    copy(phi1, c);
    copy(psi, e);
  }
}
}  // namespace

extern "C" __attribute__((visibility("default"))) const dvr_table_module* dvrlab_table_module() {
  static const dvr_table_module module = {DVR_TABLE_ABI, lanes, scratch_bytes, block, functions};
  return &module;
}
