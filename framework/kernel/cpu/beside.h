// Voxels of 8 or 16 bits with a 16-bit level of the light volume behind each: one load per lane brings two x-neighbours
// of both. backends/cpu/light_beside.h lays them out so.
#pragma once

#include "framework/kernel/cpu/fetch.h"

#ifndef DVR_SCALAR
namespace dvr {

/// Bytes of a voxel with its level.
template <class T>
constexpr int beside_bytes = sizeof(T) + 2;

/// Two x-neighbours in 64 bits: value, level, value, level.
struct beside_pair {
  inti low, high;
};

template <class T>
DVR_INLINE void values_of(beside_pair p, real& a, real& b) {
  constexpr int out = 32 - 8 * int(sizeof(T));  // what lies above the value
  constexpr bool has_sign = T(-1) < T(0);
  const vi x = p.low.v << out, y = sizeof(T) == 1 ? p.low.v : p.high.v << out;
  a = to_real(has_sign ? inti{x >> out} : shr({x}, out));
  b = to_real(has_sign ? inti{y >> out} : shr({y}, out));
}
template <class T>
DVR_INLINE void levels_of(beside_pair p, real& a, real& b) {
  constexpr int at = 8 * int(sizeof(T));
  a = to_real(shr(p.low, at) & I(0xffff));
  b = to_real((sizeof(T) == 1 ? p.high : shr(p.high, at)) & I(0xffff));
}

/// The eight corners of a cell.
struct beside_cell {
  beside_pair row[4];  // y, then z

  template <class T>
  DVR_INLINE cell8 values() const {
    cell8 c;
    values_of<T>(row[0], c.v000, c.v100);
    values_of<T>(row[1], c.v010, c.v110);
    values_of<T>(row[2], c.v001, c.v101);
    values_of<T>(row[3], c.v011, c.v111);
    return c;
  }
  template <class T>
  DVR_INLINE cell8 levels() const {
    cell8 c;
    levels_of<T>(row[0], c.v000, c.v100);
    levels_of<T>(row[1], c.v010, c.v110);
    levels_of<T>(row[2], c.v001, c.v101);
    levels_of<T>(row[3], c.v011, c.v111);
    return c;
  }
};

template <class T>
DVR_INLINE beside_pair fetch_beside(const uint8_t* p, const lane_index& n) {
  real low, high;
  fetch64_at(p, n, low, high);
  return {as_int(low), as_int(high)};
}
/// As fetch_cell: base and strides count voxels.
template <class T>
DVR_INLINE beside_cell fetch_beside_cell(const uint8_t* p, inti base, int dy, int dz) {
  const lane_index n(base * I(beside_bytes<T>));
  const uint64_t sy = uint64_t(uint32_t(dy)) * beside_bytes<T>, sz = uint64_t(uint32_t(dz)) * beside_bytes<T>;
  return {
      {fetch_beside<T>(p, n), fetch_beside<T>(p + sy, n), fetch_beside<T>(p + sz, n), fetch_beside<T>(p + sz + sy, n)}};
}

}  // namespace dvr
#endif
