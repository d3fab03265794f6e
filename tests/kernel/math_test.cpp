// The bounds that framework/kernel/math.kernel states, held against fp64 by dense sweeps; and the same bits from
// every instruction set. The worst error is printed on success too.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "backends/cpu/denormals.h"
#include "tests/kernel/probes.h"

namespace dvrlab {
namespace {

using namespace kernel_test;

constexpr long block = 4096;
constexpr std::uint32_t binade = 1u << 23;  // floats between two powers of two

/// |y - exact| in units of the last place of a float near `exact`.
double ulps(double exact, float y) {
  const double size = std::max(std::fabs(exact), 0x1p-126);
  return std::fabs(y - exact) / std::ldexp(1.0, std::ilogb(size) - 23);
}
double absolute(double exact, float y) { return std::fabs(y - exact); }

struct Sweep {
  const char* name;
  probe_map kernel_probe::*function;
  double (*exact)(double x);
  double (*error)(double exact, float y) = &ulps;
  double worst = 0;
  float at = 0;
  std::uint64_t points = 0;

  /// x(i) for i in [0, count). Every instruction set must return the bits of the first.
  template <class Input>
  void run(std::uint64_t count, Input x) {
    const cpu::KeepDenormals keep;
    std::vector<float> in(block), out(block), other(block);
    for (std::uint64_t first = 0; first < count; first += block) {
      for (long k = 0; k < block; ++k) in[std::size_t(k)] = x(std::min(first + std::uint64_t(k), count - 1));
      (isas()[0].probe->*function)(in.data(), out.data(), block);
      for (std::size_t isa = 1; isa < isas().size(); ++isa) {
        (isas()[isa].probe->*function)(in.data(), other.data(), block);
        ASSERT_EQ(std::memcmp(out.data(), other.data(), sizeof(float) * block), 0)
            << name << " of " << isas()[isa].name << " has other bits near x = " << in[0];
      }
      for (std::size_t k = 0; k < block; ++k) {
        const double e = error(exact(in[k]), out[k]);
        if (!(e <= worst)) worst = e, at = in[k];  // a NaN is the worst
      }
    }
    points += count;
  }
  /// Every float of the binades [2^first, 2^last], with a stride in the bits.
  void run_bits(int first, int last, std::uint32_t stride, float sign = 1.0f) {
    const std::uint32_t start = std::uint32_t(first + 127) << 23;
    run(std::uint64_t(last - first) * binade / stride + 1,
        [=](std::uint64_t i) { return sign * std::bit_cast<float>(start + std::uint32_t(i) * stride); });
  }
  void expect_at_most(double bound) const {
    const char* unit = error == &ulps ? "ULP" : "absolute";
    std::printf("%-14s worst %.4g %s at x = %.9g, bound %g, %llu points, %zu instruction sets\n", name, worst, unit,
                double(at), bound, static_cast<unsigned long long>(points), isas().size());
    EXPECT_LE(worst, bound) << name << " at " << at;
  }
};

TEST(KernelMath, Reciprocal) {
  Sweep s{"rcp", &kernel_probe::rcp, [](double x) { return 1.0 / x; }};
  s.run_bits(0, 1, 1);
  s.run_bits(-126, 125, 4999);
  s.run_bits(-126, 125, 40009, -1.0f);
  s.expect_at_most(2.0);
}

TEST(KernelMath, ReciprocalSquareRoot) {
  Sweep s{"rsqrt", &kernel_probe::rsqrt, [](double x) { return 1.0 / std::sqrt(x); }};
  s.run_bits(0, 2, 1);  // an even and an odd exponent
  s.run_bits(-125, 126, 4999);
  s.expect_at_most(3.0);
}

TEST(KernelMath, SquareRoot) {
  Sweep s{"sqrt", &kernel_probe::sqrt, [](double x) { return std::sqrt(x); }};
  s.run_bits(0, 2, 1);
  s.run_bits(-125, 126, 4999);
  s.run(block, [](std::uint64_t) { return 0.0f; });
  s.expect_at_most(3.0);
}

TEST(KernelMath, Exponential) {
  Sweep s{"exp", &kernel_probe::exp, [](double x) { return x < double(-87.3f) ? 0.0 : std::exp(x); }};
  s.run(10'000'000, [](std::uint64_t i) { return float(-87.3 + 175.6 * double(i) / 9'999'999); });
  s.run_bits(-30, 6, 53);
  s.run_bits(-30, 6, 53, -1.0f);
  s.run(block, [](std::uint64_t i) { return -87.25f - 0.25f * float(i); });
  s.expect_at_most(1.0);
  Sweep top{"exp above 88.3", &kernel_probe::exp, [](double) { return std::exp(double(88.3f)); }};
  top.run(block, [](std::uint64_t i) { return 88.3f + float(i); });
  top.expect_at_most(1.0);
}

TEST(KernelMath, Transmittance) {
  Sweep s{"attenuate1.t", &kernel_probe::transmittance,
          [](double x) { return x > double(87.3f) ? 0.0 : std::exp(-x); }};
  s.run(10'000'000, [](std::uint64_t i) { return float(88.0 * double(i) / 9'999'999); });
  s.run_bits(-126, 100, 4999);
  s.expect_at_most(2.0);
}

TEST(KernelMath, SelfAttenuation) {
  Sweep s{"attenuate1.phi", &kernel_probe::phi1, [](double x) { return x == 0 ? 1.0 : -std::expm1(-x) / x; }};
  s.run(10'000'000, [](std::uint64_t i) { return float(100.0 * double(i) / 9'999'999); });
  s.run_bits(-126, 100, 4999);
  s.run_bits(-2, 0, 7);  // both sides of the first range reduction, where 1 - e^-x cancels most
  s.expect_at_most(5.0);
}

double exact_sine(double t) { return std::sin(2 * std::numbers::pi * (t - std::nearbyint(t))); }

TEST(KernelMath, Sine) {
  Sweep s{"sin2pi", &kernel_probe::sin2pi, &exact_sine, &absolute};
  s.run(2'000'000, [](std::uint64_t i) { return float(-1.0 + 2.0 * double(i) / 1'999'999); });
  s.run_bits(-30, 20, 997);
  s.run_bits(-30, 20, 997, -1.0f);
  s.expect_at_most(3e-7);
}

TEST(KernelMath, Floor) {
  Sweep s{"floor", &kernel_probe::floor, [](double x) { return std::floor(x); }, &absolute};
  s.run(2'000'000, [](std::uint64_t i) { return float(-1000.0 + 0.001 * double(i)); });
  s.run_bits(-30, 30, 9973);
  s.run_bits(-30, 30, 9973, -1.0f);
  s.expect_at_most(0.0);
}

TEST(KernelMath, Power) {
  const cpu::KeepDenormals keep;
  constexpr long count = 1 << 16;
  std::vector<float> in(count), out(count), other(count);
  for (long k = 0; k < count; ++k) in[std::size_t(k)] = float(k + 1) / count;
  double worst = 0;  // relative to the bound of n - 1 ULP
  for (const int n : {1, 2, 3, 7, 8, 20, 63, 100, 1000}) {
    isas()[0].probe->power(in.data(), n, out.data(), count);
    for (const Isa& isa : isas()) {
      isa.probe->power(in.data(), n, other.data(), count);
      ASSERT_EQ(std::memcmp(out.data(), other.data(), sizeof(float) * count), 0) << isa.name << ", n = " << n;
    }
    double worst_n = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double exact = std::pow(double(in[k]), n);
      if (exact < 0x1p-125) continue;  // denormal: no ULP bound
      worst_n = std::max(worst_n, ulps(exact, out[k]));
    }
    std::printf("power          n = %4d: worst %.4g ULP, bound %d\n", n, worst_n, n - 1);
    EXPECT_LE(worst_n, n - 1);
    worst = std::max(worst, n > 1 ? worst_n / (n - 1) : worst_n);
  }
  EXPECT_GT(worst, 0.0);
}

std::uint32_t pcg_of(std::uint32_t x) {
  const std::uint32_t s = x * 747796405u + 2891336453u;
  const std::uint32_t w = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
  return (w >> 22u) ^ w;
}

TEST(KernelMath, PixelHash) {
  constexpr int count = 1 << 20;
  std::vector<int> in(count), out(count);
  for (int k = 0; k < count; ++k) in[std::size_t(k)] = int(std::uint32_t(k) * 4099u);
  for (const Isa& isa : isas()) {
    isa.probe->pcg(in.data(), out.data(), count);
    for (std::size_t k = 0; k < count; ++k)
      ASSERT_EQ(std::uint32_t(out[k]), pcg_of(std::uint32_t(in[k]))) << isa.name << ", x = " << in[k];
  }
}

TEST(KernelMath, JitterIsUniform) {
  constexpr int side = 512, count = side * side;
  std::vector<int> x(count), y(count);
  std::vector<float> offset(count);
  for (int k = 0; k < count; ++k) x[std::size_t(k)] = k % side, y[std::size_t(k)] = k / side;
  for (const Isa& isa : isas()) {
    isa.probe->jitter(x.data(), y.data(), offset.data(), count);
    std::vector<int> histogram(16);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t h = pcg_of(std::uint32_t(x[k]) + pcg_of(std::uint32_t(y[k]) + pcg_of(7)));
      ASSERT_EQ(offset[k], float(1.0 - (double(h >> 8) + 1.0) * 0x1p-24)) << isa.name << ", pixel " << k;
      ASSERT_TRUE(offset[k] >= 0.0f && offset[k] < 1.0f);
      ++histogram[std::size_t(offset[k] * 16.0f)];
    }
    // chi-squared with 15 degrees of freedom: above 50 once in 1e5
    double chi = 0;
    for (const int n : histogram) chi += (n - count / 16.0) * (n - count / 16.0) / (count / 16.0);
    EXPECT_LT(chi, 50.0) << isa.name;
  }
}

}  // namespace
}  // namespace dvrlab
