// One instruction set's part of the table builder: its entry points (table_module.h).
#include "plugins/estimator/preintegrated/slide.h"

namespace {
using namespace dvr;

/// Results below the least normal float are 0, on every instruction set alike; and no step waits for a denormal.
class FlushToZero {
 public:
  FlushToZero() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
  ~FlushToZero() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
};

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
