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
// Spelled out: g++ 12 takes a converted vector of bytes apart, one by one.
#if defined(DVR_ISA_avx512)
#define DVR_ROW8(widen) vi(_mm512_##widen(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))))
#define DVR_ROW16(widen) vi(_mm512_##widen(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))))
#elif defined(DVR_ISA_avx2)
#define DVR_ROW8(widen) vi(_mm256_##widen(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p))))
#define DVR_ROW16(widen) vi(_mm256_##widen(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))))
#else
#define DVR_ROW8(widen) vi(_mm_##widen(_mm_cvtsi32_si128(pair_u16(p))))
#define DVR_ROW16(widen) vi(_mm_##widen(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p))))
#endif
DVR_INLINE real load_row(const uint8_t* p) { return to_real({DVR_ROW8(cvtepu8_epi32)}); }
DVR_INLINE real load_row(const int8_t* p) { return to_real({DVR_ROW8(cvtepi8_epi32)}); }
DVR_INLINE real load_row(const uint16_t* p) { return to_real({DVR_ROW16(cvtepu16_epi32)}); }
DVR_INLINE real load_row(const int16_t* p) { return to_real({DVR_ROW16(cvtepi16_epi32)}); }
#undef DVR_ROW8
#undef DVR_ROW16
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
