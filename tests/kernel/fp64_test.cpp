// The bounds that framework/kernel/cpu/math_fp64.h states, held against long double over random arguments of every
// binade in range. The worst error is printed on success too.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/kernel/probe64.h"

namespace dvrlab {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64, "the reference must be finer than double");
constexpr long points = 1 << 20;
constexpr long double two_pi = 6.283185307179586476925286766559005768L;

const kernel_probe64& probe() {
  static const kernel_probe64* opened = [] {
    void* library = dlopen(DVRLAB_PROBE_FOLDER "/probe.fp64.so", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    using Entry = const kernel_probe64* (*)();
    return reinterpret_cast<Entry>(dlsym(library, "dvrlab_kernel_probe"))();
  }();
  return *opened;
}

/// |y - exact| in units of the last place of a double near `exact`.
double ulps(long double exact, double y) {
  const int exponent = std::max(std::ilogb(exact), -1022);
  return exact == 0 && y == 0 ? 0.0 : double(std::fabs(y - exact) / std::ldexp(1.0L, exponent - 52));
}

/// Arguments whose logarithm is uniform in [2^first, 2^last].
std::vector<double> binades(double first, double last, double sign = 1) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(first, last), mantissa(1, 2);
  std::vector<double> x(points);
  for (double& a : x) a = sign * mantissa(random) * std::exp2(std::floor(exponent(random)));
  return x;
}
std::vector<double> uniform(double lo, double hi) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> any(lo, hi);
  std::vector<double> x(points);
  for (double& a : x) a = any(random);
  return x;
}

/// The worst error of `function` over all of `x`; printed, and held to the bound.
void expect_ulps(const char* name, probe64_map function, long double (*exact)(long double x), double bound,
                 const std::vector<std::vector<double>>& sets) {
  double worst = 0, at = 0, rounded = 0;
  for (const std::vector<double>& x : sets) {
    std::vector<double> y(x.size());
    function(x.data(), y.data(), long(x.size()));
    for (std::size_t k = 0; k < x.size(); ++k) {
      const long double truth = exact(x[k]);
      const double e = ulps(truth, y[k]);
      if (!(e <= worst)) worst = e, at = x[k];  // a NaN is the worst
      rounded = std::max(rounded, ulps(truth, double(float(y[k]))));
    }
  }
  std::printf("%-14s worst %.3g ULP at x = %.17g, bound %g; rounded to fp32 %.3g ULP\n", name, worst, at, bound,
              rounded);
  EXPECT_LE(worst, bound) << name << " at " << at;
  EXPECT_GT(rounded, 1e6) << name << ": the comparison does not see fp32";
}

TEST(KernelFp64, Reciprocals) {
  expect_ulps("rcp", probe().rcp, [](long double x) { return 1 / x; }, 1, {binades(-120, 120), binades(-120, 120, -1)});
  expect_ulps("rsqrt", probe().rsqrt, [](long double x) { return 1 / std::sqrt(x); }, 2, {binades(-120, 120)});
  expect_ulps("sqrt", probe().sqrt, [](long double x) { return std::sqrt(x); }, 1, {binades(-120, 120)});
}

TEST(KernelFp64, Exponentials) {
  expect_ulps("exp", probe().exp, [](long double x) { return std::exp(x); }, 1,
              {uniform(-80, 80), binades(-60, 6, -1)});
  expect_ulps("attenuate1.t", probe().transmittance, [](long double x) { return std::exp(-x); }, 1,
              {uniform(0, 80), binades(-60, 6)});
  // The argument of expm1 is exact, so nothing cancels at any depth.
  expect_ulps("attenuate1.phi", probe().phi1, [](long double x) { return -std::expm1(-x) / x; }, 2,
              {uniform(0, 80), binades(-100, 9)});
}

TEST(KernelFp64, TrigonometricFunctions) {
  expect_ulps("sin2pi", probe().sin2pi,
              [](long double t) {
                const long double u = t - std::floor(t + 0.5L);
                // Exact: near a half turn the sine is that of the small remainder.
                return std::fabs(u) > 0.25L ? std::sin(two_pi * (std::copysign(0.5L, u) - u)) : std::sin(two_pi * u);
              },
              2, {uniform(-4, 4), binades(-40, 40), binades(-40, 40, -1)});
  const std::vector<double> x = uniform(-4, 4);
  std::vector<double> y(x.size());
  probe().cos2pi(x.data(), y.data(), points);
  double worst = 0;
  for (std::size_t k = 0; k < x.size(); ++k) worst = std::max(worst, double(std::fabs(y[k] - std::cos(two_pi * x[k]))));
  std::printf("cos2pi         worst %.3g absolute, bound 3e-15\n", worst);
  EXPECT_LE(worst, 3e-15);  // t + 1/4 is rounded: half a ULP of 4, times 2 pi
}

TEST(KernelFp64, WordsAtTheirEdges) {
  const auto at = [](probe64_map f, double x) {
    double y = 0;
    f(&x, &y, 1);
    return y;
  };
  EXPECT_EQ(at(probe().sqrt, 0.0), 0.0);
  EXPECT_EQ(at(probe().sqrt, -1.0), 0.0);  // as math.kernel has it
  EXPECT_EQ(at(probe().phi1, 0.0), 1.0);
  EXPECT_EQ(at(probe().transmittance, 0.0), 1.0);
  EXPECT_EQ(at(probe().transmittance, 1e6), 0.0);
  EXPECT_DOUBLE_EQ(at(probe().phi1, 1e6), 1e-6);
  EXPECT_EQ(at(probe().exp, -709.0), 0.0);
  EXPECT_EQ(at(probe().exp, 1e9), std::exp(709.0));
  EXPECT_EQ(at(probe().floor, -2.5), -3.0);
  EXPECT_EQ(at(probe().floor, 3e15), 3e15);  // beyond 32 bits
  EXPECT_EQ(at(probe().rabs, -1e-300), 1e-300);
  EXPECT_NEAR(at(probe().power20, 0.7), std::pow(0.7, 20), 20 * 0x1p-53 * std::pow(0.7, 20));
}

}  // namespace
}  // namespace dvrlab
