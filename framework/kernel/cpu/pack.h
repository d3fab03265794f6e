// SIMD packs of one instruction set: the types real, inti and mask of the kernel language, as C++.
// Chosen by DVR_ISA_<name>, where fp64 is one lane in double; everything is header-only and always inlined, so a module
// is one translation unit. Arithmetic uses the compiler's vector extension, so one text serves 4, 8 and 16 lanes; only
// masks, rounding and the assembling of loads name intrinsics.
#pragma once

#include <immintrin.h>
#include <stdint.h>
#include <string.h>

#include <new>

#define DVR_INLINE inline __attribute__((always_inline))

namespace dvr {

#if defined(DVR_ISA_avx512)
constexpr int W = 16;
#define DVR_PACKET_COLUMNS 4
#elif defined(DVR_ISA_avx2)
constexpr int W = 8;
#define DVR_PACKET_COLUMNS 4
#elif defined(DVR_ISA_sse4_2)
constexpr int W = 4;
#define DVR_PACKET_COLUMNS 2
#else
#define DVR_SCALAR 1
#define DVR_PACKET_COLUMNS 1
constexpr int W = 1;
#endif

#ifdef DVR_ISA_fp64
typedef double scalar;
#else
typedef float scalar;
#endif

#ifdef DVR_SCALAR
typedef scalar vf;
typedef int32_t vi;
typedef uint32_t vu;
#else
typedef float vf __attribute__((vector_size(4 * W)));
typedef int32_t vi __attribute__((vector_size(4 * W)));
typedef uint32_t vu __attribute__((vector_size(4 * W)));
#endif

// ---- masks ----------------------------------------------------------------------------------------------------
#if defined(DVR_ISA_avx512)
typedef __mmask16 vm;
#else
typedef vi vm;  // all ones or all zeros per lane; scalar: 1 or 0
#endif

struct mask {
  vm m;
};
DVR_INLINE mask operator&&(mask a, mask b) { return {vm(a.m & b.m)}; }
DVR_INLINE mask operator||(mask a, mask b) { return {vm(a.m | b.m)}; }
#ifdef DVR_SCALAR
DVR_INLINE mask operator!(mask a) { return {vm(a.m ^ 1)}; }
DVR_INLINE unsigned bits_of(mask a) { return unsigned(a.m); }
#elif defined(DVR_ISA_avx512)
DVR_INLINE mask operator!(mask a) { return {vm(~a.m)}; }
DVR_INLINE unsigned bits_of(mask a) { return a.m; }
#elif defined(DVR_ISA_avx2)
DVR_INLINE mask operator!(mask a) { return {~a.m}; }
DVR_INLINE unsigned bits_of(mask a) { return unsigned(_mm256_movemask_ps(__m256(a.m))); }
#else
DVR_INLINE mask operator!(mask a) { return {~a.m}; }
DVR_INLINE unsigned bits_of(mask a) { return unsigned(_mm_movemask_ps(__m128(a.m))); }
#endif
DVR_INLINE bool any_lane(mask a) { return bits_of(a) != 0; }
DVR_INLINE bool all_lanes(mask a) { return bits_of(a) == (1u << W) - 1u; }

// ---- real and inti --------------------------------------------------------------------------------------------
struct real {
  vf v;
};
struct inti {
  vi v;
};

#ifdef DVR_SCALAR
DVR_INLINE real R(scalar x) { return {x}; }
DVR_INLINE inti I(int x) { return {x}; }
DVR_INLINE real load(const scalar* p) { return {*p}; }
DVR_INLINE inti load(const int* p) { return {*p}; }
DVR_INLINE void store(scalar* p, real a) { *p = a.v; }
DVR_INLINE void store(int* p, inti a) { *p = a.v; }
DVR_INLINE int lane(inti a, int) { return a.v; }
#else
DVR_INLINE real R(float x) { return {vf{} + x}; }
DVR_INLINE inti I(int x) { return {vi{} + x}; }
DVR_INLINE real load(const float* p) {
  real a;
  memcpy(&a.v, p, sizeof(a.v));
  return a;
}
DVR_INLINE inti load(const int* p) {
  inti a;
  memcpy(&a.v, p, sizeof(a.v));
  return a;
}
DVR_INLINE void store(float* p, real a) { memcpy(p, &a.v, sizeof(a.v)); }
DVR_INLINE void store(int* p, inti a) { memcpy(p, &a.v, sizeof(a.v)); }
DVR_INLINE int lane(inti a, int l) { return a.v[l]; }
#endif

DVR_INLINE real operator+(real a, real b) { return {a.v + b.v}; }
DVR_INLINE real operator-(real a, real b) { return {a.v - b.v}; }
DVR_INLINE real operator*(real a, real b) { return {a.v * b.v}; }
DVR_INLINE real operator-(real a) { return {-a.v}; }
DVR_INLINE inti operator+(inti a, inti b) { return {vi(vu(a.v) + vu(b.v))}; }
DVR_INLINE inti operator-(inti a, inti b) { return {vi(vu(a.v) - vu(b.v))}; }
DVR_INLINE inti operator*(inti a, inti b) { return {vi(vu(a.v) * vu(b.v))}; }
DVR_INLINE inti operator&(inti a, inti b) { return {a.v & b.v}; }
DVR_INLINE inti operator|(inti a, inti b) { return {a.v | b.v}; }
DVR_INLINE inti operator^(inti a, inti b) { return {a.v ^ b.v}; }
DVR_INLINE inti shl(inti a, int n) { return {vi(vu(a.v) << n)}; }
DVR_INLINE inti shr(inti a, int n) { return {vi(vu(a.v) >> n)}; }  // logical

#if defined(DVR_ISA_avx512)
#define DVR_COMPARE(op, f, i)                                                                               \
  DVR_INLINE mask operator op(real a, real b) { return {_mm512_cmp_ps_mask(__m512(a.v), __m512(b.v), f)}; } \
  DVR_INLINE mask operator op(inti a, inti b) { return {_mm512_cmp_epi32_mask(__m512i(a.v), __m512i(b.v), i)}; }
DVR_COMPARE(<, _CMP_LT_OQ, _MM_CMPINT_LT)
DVR_COMPARE(<=, _CMP_LE_OQ, _MM_CMPINT_LE)
DVR_COMPARE(>, _CMP_GT_OQ, _MM_CMPINT_NLE)
DVR_COMPARE(>=, _CMP_GE_OQ, _MM_CMPINT_NLT)
DVR_COMPARE(==, _CMP_EQ_OQ, _MM_CMPINT_EQ)
DVR_INLINE real select(mask m, real a, real b) { return {vf(_mm512_mask_blend_ps(m.m, __m512(b.v), __m512(a.v)))}; }
DVR_INLINE inti select(mask m, inti a, inti b) {
  return {vi(_mm512_mask_blend_epi32(m.m, __m512i(b.v), __m512i(a.v)))};
}
#else
#define DVR_COMPARE(op)                                                    \
  DVR_INLINE mask operator op(real a, real b) { return {vm(a.v op b.v)}; } \
  DVR_INLINE mask operator op(inti a, inti b) { return {vm(a.v op b.v)}; }
DVR_COMPARE(<)
DVR_COMPARE(<=)
DVR_COMPARE(>)
DVR_COMPARE(>=)
DVR_COMPARE(==)
DVR_INLINE real select(mask m, real a, real b) { return {m.m ? a.v : b.v}; }
DVR_INLINE inti select(mask m, inti a, inti b) { return {m.m ? a.v : b.v}; }
#endif
#undef DVR_COMPARE

// Words whose meaning at NaN and signed zero is fixed as a select, so that every backend agrees: the smaller is
// b < a ? b : a, the larger a < b ? b : a, which is what the instructions min(b, a) and max(b, a) do.
#if defined(DVR_ISA_avx512)
DVR_INLINE real rmin(real a, real b) { return {vf(_mm512_min_ps(__m512(b.v), __m512(a.v)))}; }
DVR_INLINE real rmax(real a, real b) { return {vf(_mm512_max_ps(__m512(b.v), __m512(a.v)))}; }
DVR_INLINE inti imin(inti a, inti b) { return {vi(_mm512_min_epi32(__m512i(b.v), __m512i(a.v)))}; }
DVR_INLINE inti imax(inti a, inti b) { return {vi(_mm512_max_epi32(__m512i(b.v), __m512i(a.v)))}; }
#elif defined(DVR_ISA_avx2)
DVR_INLINE real rmin(real a, real b) { return {vf(_mm256_min_ps(__m256(b.v), __m256(a.v)))}; }
DVR_INLINE real rmax(real a, real b) { return {vf(_mm256_max_ps(__m256(b.v), __m256(a.v)))}; }
DVR_INLINE inti imin(inti a, inti b) { return {vi(_mm256_min_epi32(__m256i(b.v), __m256i(a.v)))}; }
DVR_INLINE inti imax(inti a, inti b) { return {vi(_mm256_max_epi32(__m256i(b.v), __m256i(a.v)))}; }
#elif defined(DVR_ISA_sse4_2)
DVR_INLINE real rmin(real a, real b) { return {vf(_mm_min_ps(__m128(b.v), __m128(a.v)))}; }
DVR_INLINE real rmax(real a, real b) { return {vf(_mm_max_ps(__m128(b.v), __m128(a.v)))}; }
DVR_INLINE inti imin(inti a, inti b) { return {vi(_mm_min_epi32(__m128i(b.v), __m128i(a.v)))}; }
DVR_INLINE inti imax(inti a, inti b) { return {vi(_mm_max_epi32(__m128i(b.v), __m128i(a.v)))}; }
#else
DVR_INLINE real rmin(real a, real b) { return select(b < a, b, a); }
DVR_INLINE real rmax(real a, real b) { return select(a < b, b, a); }
DVR_INLINE inti imin(inti a, inti b) { return select(b < a, b, a); }
DVR_INLINE inti imax(inti a, inti b) { return select(a < b, b, a); }
#endif

#ifdef DVR_SCALAR
DVR_INLINE inti to_int(real a) { return {int32_t(a.v)}; }  // towards zero; |a| < 2^31
DVR_INLINE real to_real(inti a) { return {scalar(a.v)}; }
#ifdef DVR_ISA_fp64
DVR_INLINE real floor(real a) { return {__builtin_floor(a.v)}; }
DVR_INLINE real rabs(real a) { return {__builtin_fabs(a.v)}; }
#else
DVR_INLINE inti as_int(real a) {
  inti r;
  memcpy(&r.v, &a.v, 4);
  return r;
}
DVR_INLINE real as_real(inti a) {
  real r;
  memcpy(&r.v, &a.v, 4);
  return r;
}
DVR_INLINE real floor(real a) {
  real t = to_real(to_int(a));
  return select(a < t, t - R(1.0f), t);
}
#endif
#else
DVR_INLINE inti to_int(real a) { return {__builtin_convertvector(a.v, vi)}; }
DVR_INLINE real to_real(inti a) { return {__builtin_convertvector(a.v, vf)}; }
DVR_INLINE inti as_int(real a) { return {vi(a.v)}; }
DVR_INLINE real as_real(inti a) { return {vf(a.v)}; }
#if defined(DVR_ISA_avx512)
DVR_INLINE real floor(real a) {
  return {vf(_mm512_roundscale_ps(__m512(a.v), _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC))};
}
#elif defined(DVR_ISA_avx2)
DVR_INLINE real floor(real a) { return {vf(_mm256_floor_ps(__m256(a.v)))}; }
#else
DVR_INLINE real floor(real a) { return {vf(_mm_floor_ps(__m128(a.v)))}; }
#endif
#endif

#ifndef DVR_ISA_fp64  // as_int and as_real speak of the 32 bits of a float
DVR_INLINE real rabs(real a) { return as_real(as_int(a) & I(0x7fffffff)); }
#endif

/// The largest lane: for loop bounds of the modules, not a kernel word.
DVR_INLINE int max_lane(inti a) {
  int r = lane(a, 0);
  for (int l = 1; l < W; ++l) r = r < lane(a, l) ? lane(a, l) : r;
  return r;
}

}  // namespace dvr
