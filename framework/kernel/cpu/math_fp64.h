// The elementary functions of math.kernel in double, for kernel modules of precision fp64 (docs/adr/0006): libm's
// accuracy instead of polynomials for fp32. Not guarded: included into every variant. ULP bounds are measured by
// tests/kernel/fp64_test.cpp; bits may differ between C libraries.

KFN static real rcp(real x) { return {1.0 / x.v}; }                    // 1 ULP
KFN static real rsqrt(real x) { return {1.0 / __builtin_sqrt(x.v)}; }  // 2 ULP, x > 0
KFN static real sqrt(real x) { return {x.v > 0.0 ? __builtin_sqrt(x.v) : 0.0}; }

// e^x: 1 ULP for x in [-708, 709]; 0 below -708 (never denormal); x above 709 counts as 709.
KFN static real exp(real x) { return {x.v < -708.0 ? 0.0 : __builtin_exp(x.v < 709.0 ? x.v : 709.0)}; }

// Transmittance t = e^-x and self-attenuation phi = phi1(x) = (1 - e^-x) / x of a depth x >= 0, phi1(0) = 1:
// t 1 ULP (0 above 708), phi 2 ULP.
struct attenuation {
  real t;
  real phi;
};
KFN static attenuation attenuate1(real x) { return {exp(-x), {x.v > 0.0 ? -__builtin_expm1(-x.v) / x.v : 1.0}}; }

// psi(x) = (phi1(x) - e^-x) / x, psi(0) = 1/2, from the attenuation of x: 20 ULP.
KFN static real psi(real x, attenuation a) {
  if (x.v >= 0.25) return {(a.phi.v - a.t.v) / x.v};
  double sum = 0.0, term = 1.0;
  for (int k = 0; k < 12; ++k) {
    sum += term / (k + 2);
    term *= -x.v / (k + 1);
  }
  return {sum};
}

// Depth -ln(1 - a) of an opacity a in [0, 1]: 1 ULP; at most 708.
KFN static real depth_of_opacity(real a) { return {a.v < 1.0 ? __builtin_fmin(-__builtin_log1p(-a.v), 708.0) : 708.0}; }
// sin(2 pi t): 2 ULP for |t| <= 2^50 (t is reduced exactly).
KFN static real sin2pi(real t) {
  const double u = t.v - __builtin_floor(t.v + 0.5);
  const double w = __builtin_fabs(u) > 0.25 ? __builtin_copysign(0.5, u) - u : u;
  return {__builtin_sin(6.283185307179586 * w)};
}
