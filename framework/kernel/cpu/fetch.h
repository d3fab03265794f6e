// Fetch primitives of the kernel language, as C++: the only access to voxels and tables.
// Hardware gathers are slow (docs/adr/0001): two x-neighbours come with one 64-bit load per lane, a table entry
// with one 128-bit load per lane, both transposed in registers.
#pragma once

#include "framework/kernel/cpu/pack.h"

namespace dvr {

struct vec4r {
  real x, y, z, w;
};
DVR_INLINE vec4r operator+(vec4r a, vec4r b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
DVR_INLINE vec4r operator-(vec4r a, vec4r b) { return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}; }
DVR_INLINE vec4r operator*(vec4r a, vec4r b) { return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w}; }
DVR_INLINE vec4r operator*(vec4r a, real b) { return {a.x * b, a.y * b, a.z * b, a.w * b}; }

/// The eight voxels of a cell, x fastest.
struct cell8 {
  real v000, v100, v010, v110, v001, v101, v011, v111;
};

template <class T>
struct voxels {
  const T* data;
};
struct table4 {
  const scalar* data;
};
struct tablei {
  const int32_t* data;
};
struct tablei4 {
  const int32_t* data;
};
struct vec4i {
  inti x, y, z, w;
};
struct bytes8 {
  const uint8_t* data;
};

/// Lane indices in memory: the loads below address lane by lane. Unsigned: volumes up to 2^32 voxels.
struct lane_index {
  alignas(64) uint32_t i[W];
  explicit DVR_INLINE lane_index(inti a) {
    memcpy(i, &a.v, sizeof(i));
    // Keeps the indices in memory: g++ 12 would rather extract them one by one from the register (1.3x slower).
    asm("" : "+m"(*reinterpret_cast<uint32_t(*)[W]>(i)));
  }
};

#ifdef DVR_SCALAR

template <class T>
DVR_INLINE real fetch1(voxels<T> b, inti i) {
  return {scalar(b.data[uint32_t(i.v)])};
}
template <class T>
DVR_INLINE void fetch2_at(const T* p, const lane_index& i, real& a, real& b) {
  a = {scalar(p[i.i[0]])};
  b = {scalar(p[i.i[0] + 1])};
}
DVR_INLINE inti fetchi(tablei b, inti i) { return {b.data[i.v]}; }
DVR_INLINE inti fetchi(bytes8 b, inti i) { return {b.data[uint32_t(i.v)]}; }
DVR_INLINE vec4i fetchi4(tablei4 b, inti i) {
  const int32_t* p = b.data + 4 * std::ptrdiff_t(i.v);
  return {{p[0]}, {p[1]}, {p[2]}, {p[3]}};
}
DVR_INLINE vec4r fetch4(table4 b, inti i) {
  const scalar* p = b.data + 4 * i.v;
  return {{p[0]}, {p[1]}, {p[2]}, {p[3]}};
}
DVR_INLINE vec4r fetch4_affine(table4 b, inti i, real w) {
  const scalar* p = b.data + 8 * i.v;
  return {{p[0] + p[4] * w.v}, {p[1] + p[5] * w.v}, {p[2] + p[6] * w.v}, {p[3] + p[7] * w.v}};
}

#else

#define DVR_LANES4(f, o) f(o + 0), f(o + 1), f(o + 2), f(o + 3)
#if defined(DVR_ISA_avx512)
#define DVR_LANES(f) DVR_LANES4(f, 0), DVR_LANES4(f, 4), DVR_LANES4(f, 8), DVR_LANES4(f, 12)
#elif defined(DVR_ISA_avx2)
#define DVR_LANES(f) DVR_LANES4(f, 0), DVR_LANES4(f, 4)
#else
#define DVR_LANES(f) DVR_LANES4(f, 0)
#endif

template <class T>
DVR_INLINE real fetch1(voxels<T> b, inti i) {
  const lane_index n(i);
#define DVR_ONE(l) int32_t(b.data[n.i[l]])
  const vi r = {DVR_LANES(DVR_ONE)};
#undef DVR_ONE
  return to_real({r});
}
DVR_INLINE real fetch1(voxels<float> b, inti i) {
  const lane_index n(i);
#define DVR_ONE(l) b.data[n.i[l]]
  const vf r = {DVR_LANES(DVR_ONE)};
#undef DVR_ONE
  return {r};
}
DVR_INLINE inti fetchi(tablei b, inti i) {
  const lane_index n(i);
#define DVR_ONE(l) b.data[n.i[l]]
  const vi r = {DVR_LANES(DVR_ONE)};
#undef DVR_ONE
  return {r};
}
DVR_INLINE inti fetchi(bytes8 b, inti i) {
  const lane_index n(i);
#define DVR_ONE(l) int32_t(b.data[n.i[l]])
  const vi r = {DVR_LANES(DVR_ONE)};
#undef DVR_ONE
  return {r};
}

// ---- pairs: elements i and i+1 of every lane -----------------------------------------------------------------
/// The 64 bits at element i, then those at element j.
template <class T>
DVR_INLINE __m128 pair64(const T* p, uint32_t i, uint32_t j) {
  __m128 r = _mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(p + i)));
  return _mm_loadh_pi(r, reinterpret_cast<const __m64*>(p + j));
}
DVR_INLINE uint16_t pair_u8(const void* p) {
  uint16_t r;
  memcpy(&r, p, 2);
  return r;
}
DVR_INLINE int32_t pair_u16(const void* p) {
  int32_t r;
  memcpy(&r, p, 4);
  return r;
}

#if defined(DVR_ISA_avx512)
DVR_INLINE __m512 join(__m128 a, __m128 b, __m128 c, __m128 d) {
  const __m256 ab = _mm256_insertf128_ps(_mm256_castps128_ps256(a), b, 1);
  const __m256 cd = _mm256_insertf128_ps(_mm256_castps128_ps256(c), d, 1);
  return _mm512_insertf32x8(_mm512_castps256_ps512(ab), cd, 1);
}
template <class T>
DVR_INLINE void fetch64_at(const T* p, const lane_index& n, real& a, real& b) {
#define DVR_PAIR(l) pair64(p, n.i[l], n.i[l + 1])
  const __m512 x = join(DVR_PAIR(0), DVR_PAIR(4), DVR_PAIR(8), DVR_PAIR(12));
  const __m512 y = join(DVR_PAIR(2), DVR_PAIR(6), DVR_PAIR(10), DVR_PAIR(14));
#undef DVR_PAIR
  a = {vf(_mm512_shuffle_ps(x, y, 0x88))};
  b = {vf(_mm512_shuffle_ps(x, y, 0xdd))};
}
#elif defined(DVR_ISA_avx2)
template <class T>
DVR_INLINE void fetch64_at(const T* p, const lane_index& n, real& a, real& b) {
#define DVR_PAIR(l) pair64(p, n.i[l], n.i[l + 1])
  const __m256 x = _mm256_insertf128_ps(_mm256_castps128_ps256(DVR_PAIR(0)), DVR_PAIR(4), 1);
  const __m256 y = _mm256_insertf128_ps(_mm256_castps128_ps256(DVR_PAIR(2)), DVR_PAIR(6), 1);
#undef DVR_PAIR
  a = {vf(_mm256_shuffle_ps(x, y, 0x88))};
  b = {vf(_mm256_shuffle_ps(x, y, 0xdd))};
}
#else
template <class T>
DVR_INLINE void fetch64_at(const T* p, const lane_index& n, real& a, real& b) {
  const __m128 x = pair64(p, n.i[0], n.i[1]);
  const __m128 y = pair64(p, n.i[2], n.i[3]);
  a = {vf(_mm_shuffle_ps(x, y, 0x88))};
  b = {vf(_mm_shuffle_ps(x, y, 0xdd))};
}
#endif
DVR_INLINE void fetch2_at(const float* p, const lane_index& n, real& a, real& b) { fetch64_at(p, n, a, b); }

// Two 8-bit voxels in 16 bits, two 16-bit voxels in 32 bits, widened in registers. The 16-bit loads are spelled as
// inserts: an initializer list makes g++ 12 carry them through mask registers.
DVR_INLINE __m128i pairs8(const void* voxels8, const lane_index& n, int first) {
  const uint8_t* p = static_cast<const uint8_t*>(voxels8);
  __m128i a = _mm_cvtsi32_si128(pair_u8(p + n.i[first]));
  a = _mm_insert_epi16(a, pair_u8(p + n.i[first + 1]), 1);
  a = _mm_insert_epi16(a, pair_u8(p + n.i[first + 2]), 2);
  a = _mm_insert_epi16(a, pair_u8(p + n.i[first + 3]), 3);
#if !defined(DVR_ISA_sse4_2)
  a = _mm_insert_epi16(a, pair_u8(p + n.i[first + 4]), 4);
  a = _mm_insert_epi16(a, pair_u8(p + n.i[first + 5]), 5);
  a = _mm_insert_epi16(a, pair_u8(p + n.i[first + 6]), 6);
  a = _mm_insert_epi16(a, pair_u8(p + n.i[first + 7]), 7);
#endif
  return a;
}
#if defined(DVR_ISA_avx512)
DVR_INLINE vi load_pairs8(const void* p, const lane_index& n) {
  const __m128i a = pairs8(p, n, 0), b = pairs8(p, n, 8);
  return vi(_mm512_cvtepu16_epi32(_mm256_inserti128_si256(_mm256_castsi128_si256(a), b, 1)));
}
#elif defined(DVR_ISA_avx2)
DVR_INLINE vi load_pairs8(const void* p, const lane_index& n) { return vi(_mm256_cvtepu16_epi32(pairs8(p, n, 0))); }
#else
DVR_INLINE vi load_pairs8(const void* p, const lane_index& n) { return vi(_mm_cvtepu16_epi32(pairs8(p, n, 0))); }
#endif
#define DVR_ONE16(l) pair_u16(p + n.i[l])
DVR_INLINE void fetch2_at(const uint8_t* p, const lane_index& n, real& a, real& b) {
  const vi w = load_pairs8(p, n);
  a = to_real({w & 0xff});
  b = to_real({w >> 8});
}
DVR_INLINE void fetch2_at(const int8_t* p, const lane_index& n, real& a, real& b) {
  const vi w = load_pairs8(p, n);
  a = to_real({(w << 24) >> 24});
  b = to_real({(w << 16) >> 24});
}
DVR_INLINE void fetch2_at(const uint16_t* p, const lane_index& n, real& a, real& b) {
  const vi w = {DVR_LANES(DVR_ONE16)};
  a = to_real({w & 0xffff});
  b = to_real(shr({w}, 16));
}
DVR_INLINE void fetch2_at(const int16_t* p, const lane_index& n, real& a, real& b) {
  const vi w = {DVR_LANES(DVR_ONE16)};
  a = to_real({(w << 16) >> 16});
  b = to_real({w >> 16});
}
#undef DVR_ONE16

// ---- table entries: lane 4b+j lies in 128-bit block b of zmm j, so a 4x4 transpose inside the blocks ends the work
#if defined(DVR_ISA_avx512)
typedef __m512 vblock;
DVR_INLINE vblock block4(const float* p, const lane_index& n, int j, int scale, int offset) {
  return join(_mm_loadu_ps(p + n.i[j] * scale + offset), _mm_loadu_ps(p + n.i[4 + j] * scale + offset),
              _mm_loadu_ps(p + n.i[8 + j] * scale + offset), _mm_loadu_ps(p + n.i[12 + j] * scale + offset));
}
#define DVR_B(name) _mm512_##name
#elif defined(DVR_ISA_avx2)
typedef __m256 vblock;
DVR_INLINE vblock block4(const float* p, const lane_index& n, int j, int scale, int offset) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p + n.i[j] * scale + offset)),
                              _mm_loadu_ps(p + n.i[4 + j] * scale + offset), 1);
}
#define DVR_B(name) _mm256_##name
#else
typedef __m128 vblock;
DVR_INLINE vblock block4(const float* p, const lane_index& n, int j, int scale, int offset) {
  return _mm_loadu_ps(p + n.i[j] * scale + offset);
}
#define DVR_B(name) _mm_##name
#endif

DVR_INLINE vec4r transpose4(vblock a, vblock b, vblock c, vblock d) {
  const vblock t0 = DVR_B(unpacklo_ps)(a, b), t1 = DVR_B(unpacklo_ps)(c, d);
  const vblock t2 = DVR_B(unpackhi_ps)(a, b), t3 = DVR_B(unpackhi_ps)(c, d);
  return {{vf(DVR_B(shuffle_ps)(t0, t1, 0x44))},
          {vf(DVR_B(shuffle_ps)(t0, t1, 0xee))},
          {vf(DVR_B(shuffle_ps)(t2, t3, 0x44))},
          {vf(DVR_B(shuffle_ps)(t2, t3, 0xee))}};
}
DVR_INLINE vec4r fetch4(table4 b, inti i) {
  const lane_index n(i);
  return transpose4(block4(b.data, n, 0, 4, 0), block4(b.data, n, 1, 4, 0), block4(b.data, n, 2, 4, 0),
                    block4(b.data, n, 3, 4, 0));
}
/// The same, bit for bit: nothing computes with the numbers on the way.
DVR_INLINE vec4i fetchi4(tablei4 b, inti i) {
  const lane_index n(i);
  const float* p = reinterpret_cast<const float*>(b.data);
  const vec4r r =
      transpose4(block4(p, n, 0, 4, 0), block4(p, n, 1, 4, 0), block4(p, n, 2, 4, 0), block4(p, n, 3, 4, 0));
  return {as_int(r.x), as_int(r.y), as_int(r.z), as_int(r.w)};
}
/// Entries are pairs (value, difference to the next): value + difference * w, interpolated before the transpose,
/// where one multiply-add serves four channels of a quarter of the lanes.
DVR_INLINE vec4r fetch4_affine(table4 b, inti i, real w) {
  const lane_index n(i);
#define DVR_ROW(j, imm)                   \
  vblock(vf(block4(b.data, n, j, 8, 0)) + \
         vf(block4(b.data, n, j, 8, 4)) * vf(DVR_B(shuffle_ps)(vblock(w.v), vblock(w.v), imm)))
  return transpose4(DVR_ROW(0, 0x00), DVR_ROW(1, 0x55), DVR_ROW(2, 0xaa), DVR_ROW(3, 0xff));
#undef DVR_ROW
}
#undef DVR_B
#undef DVR_LANES
#undef DVR_LANES4

#endif

template <class T>
DVR_INLINE void fetch2(voxels<T> b, inti i, real& a, real& c) {
  fetch2_at(b.data, lane_index(i), a, c);
}
/// The cell whose first voxel has index `base`; dy and dz are the strides of y and z in voxels.
template <class T>
DVR_INLINE cell8 fetch_cell(voxels<T> b, inti base, int dy, int dz) {
  const lane_index n(base);
  const uint64_t sy = uint32_t(dy), sz = uint32_t(dz);
  cell8 r;
  fetch2_at(b.data, n, r.v000, r.v100);
  fetch2_at(b.data + sy, n, r.v010, r.v110);
  fetch2_at(b.data + sz, n, r.v001, r.v101);
  fetch2_at(b.data + sz + sy, n, r.v011, r.v111);
  return r;
}
/// The same with strides of each lane's own.
template <class T>
DVR_INLINE cell8 fetch_cell(voxels<T> b, inti base, inti dy, inti dz) {
  cell8 r;
  fetch2(b, base, r.v000, r.v100);
  fetch2(b, base + dy, r.v010, r.v110);
  fetch2(b, base + dz, r.v001, r.v101);
  fetch2(b, base + dz + dy, r.v011, r.v111);
  return r;
}
/// An entry that is the same for all lanes.
DVR_INLINE vec4r fetch4u(table4 b, int i) {
  const scalar* p = b.data + 4 * i;
  return {R(p[0]), R(p[1]), R(p[2]), R(p[3])};
}

}  // namespace dvr
