// fp64 numbers in the lanes of one instruction set, and the functions of the segment integrals on them. Arithmetic
// uses the compiler's vector extension without contraction, so every instruction set computes the same bits.
#pragma once

#include <stdint.h>
#include <string.h>
#include <xmmintrin.h>
#if defined(DVR_ISA_avx2) || defined(DVR_ISA_avx512) || defined(DVR_ISA_sse4_2)
#include <immintrin.h>
#endif

#define DVR_INLINE inline __attribute__((always_inline))

namespace dvr {

#if defined(DVR_ISA_avx512)
constexpr int native = 8;
#elif defined(DVR_ISA_avx2)
constexpr int native = 4;
#elif defined(DVR_ISA_sse4_2)
constexpr int native = 2;
#else
constexpr int native = 1;
#endif
/// Lanes per pack: at least 4, so that a step writes whole cache lines of 4 entries.
constexpr int lanes = native < 4 ? 4 : native;
constexpr int parts = lanes / native;

#if defined(DVR_ISA_avx512) || defined(DVR_ISA_avx2) || defined(DVR_ISA_sse4_2)
typedef double nd __attribute__((vector_size(8 * native)));
typedef int64_t ni __attribute__((vector_size(8 * native)));
#else
typedef double nd;
typedef int64_t ni;
#endif

struct vd {
  nd p[parts];
};
/// Of a comparison: all ones or all zeros per lane.
struct vm {
#if defined(DVR_ISA_avx512) || defined(DVR_ISA_avx2) || defined(DVR_ISA_sse4_2)
  ni p[parts];
#else
  bool p[parts];
#endif
};

#define DVR_EACH_PART _Pragma("GCC unroll 8") for (int k = 0; k < parts; ++k)
DVR_INLINE vd all(double x) {
  vd r;
  DVR_EACH_PART r.p[k] = x - nd{};
  return r;
}
DVR_INLINE vd load(const double* p) {
  vd r;
  memcpy(&r, p, sizeof(r));
  return r;
}
DVR_INLINE void store(double* p, vd a) { memcpy(p, &a, sizeof(a)); }
#define DVR_OPERATOR(op)                     \
  DVR_INLINE vd operator op(vd a, vd b) {    \
    vd r;                                    \
    DVR_EACH_PART r.p[k] = a.p[k] op b.p[k]; \
    return r;                                \
  }
DVR_OPERATOR(+)
DVR_OPERATOR(-)
DVR_OPERATOR(*)
DVR_OPERATOR(/)
#undef DVR_OPERATOR
DVR_INLINE vm operator<(vd a, vd b) {
  vm r;
  DVR_EACH_PART r.p[k] = a.p[k] < b.p[k];
  return r;
}
/// a where the mask is set, otherwise b.
DVR_INLINE vd select(vm m, vd a, vd b) {
  vd r;
  DVR_EACH_PART r.p[k] = m.p[k] ? a.p[k] : b.p[k];
  return r;
}
DVR_INLINE vd at_least(vd a, double least) {
  const vd l = all(least);
  return select(l < a, a, l);
}

/// Element l of the result is p[l * stride].
DVR_INLINE vd load_strided(const double* p, intptr_t stride) {
  vd r;
#if defined(DVR_ISA_avx512)
  r.p[0] =
      nd{p[0], p[stride], p[2 * stride], p[3 * stride], p[4 * stride], p[5 * stride], p[6 * stride], p[7 * stride]};
#elif defined(DVR_ISA_avx2)
  r.p[0] = nd{p[0], p[stride], p[2 * stride], p[3 * stride]};
#elif defined(DVR_ISA_sse4_2)
  r.p[0] = nd{p[0], p[stride]};
  r.p[1] = nd{p[2 * stride], p[3 * stride]};
#else
  DVR_EACH_PART r.p[k] = p[k * stride];
#endif
  return r;
}

/// e^-x and 1 - e^-x of a depth x >= 0, each to 2 ulp; beyond 708 exactly 0 and 1. Cody-Waite reduction by ln 2 and the
/// Taylor polynomial of degree 13 of e^r - 1, |r| <= ln(2)/2, so the opacity of a thin cell keeps all its digits.
DVR_INLINE void exp_minus(vd x, vd& t, vd& opacity) {
  const vd limit = all(708.0);
  const vm thin = x < limit;
  const vd y = select(thin, x, limit);
  // The magic number leaves the whole number k + 1023 in the low bits: the exponent of 2^k.
  const vd magic = all(6755399441055744.0 + 1023.0);
  const vd shifted = y * all(-1.4426950408889634074) + magic;
  const vd k = shifted - magic;
  vd scale;
  for (int j = 0; j < parts; ++j) {
    ni bits;
    memcpy(&bits, &shifted.p[j], sizeof(bits));
#if defined(DVR_ISA_avx512) || defined(DVR_ISA_avx2) || defined(DVR_ISA_sse4_2)
    bits = bits << 52;
#else
    bits = static_cast<int64_t>(static_cast<uint64_t>(bits) << 52);
#endif
    memcpy(&scale.p[j], &bits, sizeof(bits));
  }
  const vd r = (all(0.0) - y - k * all(6.93147180369123816490e-01)) - k * all(1.90821492927058770002e-10);
  const vd s = r * r;
  // Even and odd coefficients 1/j! apart: two short chains.
  vd even = all(1.0 / 479001600.0), odd = all(1.0 / 6227020800.0);
  even = even * s + all(1.0 / 3628800.0);
  odd = odd * s + all(1.0 / 39916800.0);
  even = even * s + all(1.0 / 40320.0);
  odd = odd * s + all(1.0 / 362880.0);
  even = even * s + all(1.0 / 720.0);
  odd = odd * s + all(1.0 / 5040.0);
  even = even * s + all(1.0 / 24.0);
  odd = odd * s + all(1.0 / 120.0);
  even = even * s + all(0.5);
  odd = odd * s + all(1.0 / 6.0);
  const vd p = r + s * (even + r * odd);
  t = select(thin, scale * (all(1.0) + p), all(0.0));  // scale * p alone could be flushed to 0
  opacity = select(thin, (all(1.0) - scale) - scale * p, all(1.0));
}

DVR_INLINE vd exp_minus(vd x) {
  vd t, opacity;
  exp_minus(x, t, opacity);
  return t;
}

/// phi1(q) = (1 - e^-q) / q, phi1(0) = 1, from the opacity 1 - e^-q.
DVR_INLINE vd phi1_of(vd q, vd opacity) {
  const vm some = all(1e-290) < q;
  return select(some, opacity / select(some, q, all(1.0)), all(1.0));
}

/// psi(q) = (1 - (1 + q) e^-q) / q^2 = (phi1 - e^-q) / q, psi(0) = 1/2; below 1/4 its series sum (-q)^k / (k! (k + 2)).
DVR_INLINE vd psi_of(vd q, vd t, vd phi1) {
  const vm thin = q < all(0.25);
  constexpr double c[] = {1.0 / 2,    -1.0 / 3,     1.0 / 8,      -1.0 / 30,      1.0 / 144,      -1.0 / 840,
                          1.0 / 5760, -1.0 / 45360, 1.0 / 403200, -1.0 / 3991680, 1.0 / 43545600, -1.0 / 518918400};
  vd series = all(c[11]);
#pragma GCC unroll 12
  for (int k = 10; k >= 0; --k) series = series * q + all(c[k]);
  return select(thin, series, (phi1 - t) / select(thin, all(1.0), q));
}

/// psi_2(q) = int_0^1 u^2 e^-qu du and psi_3(q) with u^3, by the recurrence q psi_k = k psi_(k-1) - e^-q or their
/// series.
DVR_INLINE void higher_psi_of(vd q, vd t, vd psi, vd& second, vd& third) {
  const vm thin = q < all(0.25);
  constexpr double inverse_factorial[] = {1.0,         -1.0,          1.0 / 2,       -1.0 / 6,
                                          1.0 / 24,    -1.0 / 120,    1.0 / 720,     -1.0 / 5040,
                                          1.0 / 40320, -1.0 / 362880, 1.0 / 3628800, -1.0 / 39916800};
  vd a = all(inverse_factorial[11] / 14), b = all(inverse_factorial[11] / 15);
#pragma GCC unroll 12
  for (int k = 10; k >= 0; --k) {
    a = a * q + all(inverse_factorial[k] / (k + 3));
    b = b * q + all(inverse_factorial[k] / (k + 4));
  }
  const vd some = select(thin, all(1.0), q);
  second = select(thin, a, (all(2.0) * psi - t) / some);
  third = select(thin, b, (all(3.0) * second - t) / some);
}

/// Four packs as `lanes` vectors of 4 floats, from `to` on (64-byte aligned); `stream` writes past the caches.
DVR_INLINE void store_channels(float* to, vd a, vd b, vd c, vd d, bool stream) {
#if defined(DVR_ISA_avx512)
  const __m256 fa = _mm512_cvtpd_ps(__m512d(a.p[0])), fb = _mm512_cvtpd_ps(__m512d(b.p[0])),
               fc = _mm512_cvtpd_ps(__m512d(c.p[0])), fd = _mm512_cvtpd_ps(__m512d(d.p[0]));
  // Pairs (a, b) and (c, d) per lane, then lanes 0, 1, 4, 5 and 2, 3, 6, 7 as vectors of 4.
  const __m256 ab0 = _mm256_unpacklo_ps(fa, fb), ab1 = _mm256_unpackhi_ps(fa, fb);
  const __m256 cd0 = _mm256_unpacklo_ps(fc, fd), cd1 = _mm256_unpackhi_ps(fc, fd);
  const __m256 v04 = _mm256_shuffle_ps(ab0, cd0, 0x44), v15 = _mm256_shuffle_ps(ab0, cd0, 0xee);
  const __m256 v26 = _mm256_shuffle_ps(ab1, cd1, 0x44), v37 = _mm256_shuffle_ps(ab1, cd1, 0xee);
  const __m256 v01 = _mm256_permute2f128_ps(v04, v15, 0x20), v45 = _mm256_permute2f128_ps(v04, v15, 0x31);
  const __m256 v23 = _mm256_permute2f128_ps(v26, v37, 0x20), v67 = _mm256_permute2f128_ps(v26, v37, 0x31);
  const __m512 first = _mm512_insertf32x8(_mm512_castps256_ps512(v01), v23, 1);
  const __m512 last = _mm512_insertf32x8(_mm512_castps256_ps512(v45), v67, 1);
  if (stream) {
    _mm512_stream_ps(to, first);
    _mm512_stream_ps(to + 16, last);
  } else {
    _mm512_store_ps(to, first);
    _mm512_store_ps(to + 16, last);
  }
#else
#if defined(DVR_ISA_avx2)
  __m128 v0 = _mm256_cvtpd_ps(__m256d(a.p[0])), v1 = _mm256_cvtpd_ps(__m256d(b.p[0]));
  __m128 v2 = _mm256_cvtpd_ps(__m256d(c.p[0])), v3 = _mm256_cvtpd_ps(__m256d(d.p[0]));
#elif defined(DVR_ISA_sse4_2)
  const auto four = [](vd x) { return _mm_movelh_ps(_mm_cvtpd_ps(__m128d(x.p[0])), _mm_cvtpd_ps(__m128d(x.p[1]))); };
  __m128 v0 = four(a), v1 = four(b), v2 = four(c), v3 = four(d);
#else
  const auto four = [](vd x) { return _mm_setr_ps(float(x.p[0]), float(x.p[1]), float(x.p[2]), float(x.p[3])); };
  __m128 v0 = four(a), v1 = four(b), v2 = four(c), v3 = four(d);
#endif
  _MM_TRANSPOSE4_PS(v0, v1, v2, v3);
  if (stream) {
    _mm_stream_ps(to, v0);
    _mm_stream_ps(to + 4, v1);
    _mm_stream_ps(to + 8, v2);
    _mm_stream_ps(to + 12, v3);
  } else {
    _mm_store_ps(to, v0);
    _mm_store_ps(to + 4, v1);
    _mm_store_ps(to + 8, v2);
    _mm_store_ps(to + 12, v3);
  }
#endif
}

}  // namespace dvr
