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

/// The values of a pair, or with `level` its levels.
template <class T, bool level>
DVR_INLINE void unpack(beside_pair p, real& a, real& b) {
  if constexpr (level) {
    constexpr int at = 8 * int(sizeof(T));
    a = to_real(shr(p.low, at) & I(0xffff));
    b = to_real((sizeof(T) == 1 ? p.high : shr(p.high, at)) & I(0xffff));
  } else {
    constexpr int out = 32 - 8 * int(sizeof(T));  // what lies above the value
    constexpr bool has_sign = T(-1) < T(0);
    const vi x = p.low.v << out, y = sizeof(T) == 1 ? p.low.v : p.high.v << out;
    a = to_real(has_sign ? inti{x >> out} : shr({x}, out));
    b = to_real(has_sign ? inti{y >> out} : shr({y}, out));
  }
}

/// The eight corners of a cell.
struct beside_cell {
  beside_pair row[4];  // y, then z

  template <class T, bool level>
  DVR_INLINE cell8 corners() const {
    cell8 c;
    unpack<T, level>(row[0], c.v000, c.v100);
    unpack<T, level>(row[1], c.v010, c.v110);
    unpack<T, level>(row[2], c.v001, c.v101);
    unpack<T, level>(row[3], c.v011, c.v111);
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
