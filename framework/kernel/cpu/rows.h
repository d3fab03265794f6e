// Cells of volumes for lanes that mostly stand side by side: rows of voxels whose positions differ by one in x. They
// are read as rows then, with the same numbers in the same lanes.
#pragma once

#include "framework/kernel/cpu/kernel.h"

namespace dvr {

#ifdef DVR_SCALAR
template <class T>
DVR_INLINE cell8 fetch_row_cell(voxels<T> b, inti base, int dy, int dz) {
  return fetch_cell(b, base, dy, dz);
}
#else
template <class T>
DVR_INLINE real load_row(const T* p) {
  typedef T row __attribute__((vector_size(W * sizeof(T))));
  row r;
  memcpy(&r, p, sizeof(r));
  return to_real({__builtin_convertvector(r, vi)});
}
DVR_INLINE real load_row(const float* p) {
  vf r;
  memcpy(&r, p, sizeof(r));
  return {r};
}
template <class T>
DVR_INLINE cell8 fetch_row_cell(voxels<T> b, inti base, int dy, int dz) {
  vi beside;
  for (int l = 0; l < W; ++l) beside[l] = l;
  const uint32_t first = uint32_t(base.v[0]);
  if (!all_lanes(base - inti{beside} == I(int(first)))) return fetch_cell(b, base, dy, dz);
  const uint64_t sy = uint32_t(dy), sz = uint32_t(dz);
  const T* p = b.data + first;
  return {load_row(p),      load_row(p + 1),      load_row(p + sy),      load_row(p + sy + 1),
          load_row(p + sz), load_row(p + sz + 1), load_row(p + sz + sy), load_row(p + sz + sy + 1)};
}
#endif

}  // namespace dvr
