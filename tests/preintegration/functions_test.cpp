// The modules' own fp64 functions, in units in the last place of the true value.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

#include "backends/cpu/isa.h"
#include "plugins/estimator/preintegrated/table_library.h"

namespace dvrlab::test {
namespace {

struct Values {
  std::vector<double> t, opacity, phi1, psi;
};

Values evaluate(const std::string& isa, const std::vector<double>& x) {
  Values v;
  for (auto* a : {&v.t, &v.opacity, &v.phi1, &v.psi}) a->resize(x.size());
  preintegrated::table_module(DVRLAB_TABLE_MODULES, isa)
      .functions(x.data(), int(x.size()), v.t.data(), v.opacity.data(), v.phi1.data(), v.psi.data());
  return v;
}

// Depths of every magnitude, dense where the functions change their form; a length that fills no pack.
std::vector<double> depths() {
  std::vector<double> x = {0,     1e-300, 1e-17, 0.25, std::nextafter(0.25, 0), 0.34657359027997264, 1,
                           707.9, 708,    709,   1e9};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-40, 9.4), wide(0, 708), narrow(0, 1);
  for (int k = 0; k < 200000; ++k) {
    x.push_back(std::exp2(exponent(random)));
    x.push_back(wide(random));
    x.push_back(narrow(random));
  }
  return x;
}

long double psi_exact(long double q) {
  if (q > 1) return (1 - (1 + q) * std::exp(-q)) / (q * q);
  long double sum = 0, term = 1;
  for (int k = 0; k < 40; ++k) {
    sum += term / (k + 2);
    term *= -q / (k + 1);
  }
  return sum;
}

double ulps(double x, long double exact) {
  const double near = static_cast<double>(exact);
  return std::abs(double((x - exact) / (std::nextafter(near, INFINITY) - near)));
}

struct Worst {
  double t = 0, opacity = 0, phi1 = 0, psi = 0;
};
Worst worst(const Values& v, const std::vector<double>& x) {
  Worst w;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const long double q = x[k];
    if (q < 708) w.t = std::max(w.t, ulps(v.t[k], std::exp(-q)));
    w.opacity = std::max(w.opacity, q == 0 ? (v.opacity[k] == 0 ? 0 : INFINITY) : ulps(v.opacity[k], -std::expm1(-q)));
    w.phi1 = std::max(w.phi1, ulps(v.phi1[k], q == 0 ? 1 : -std::expm1(-q) / q));
    w.psi = std::max(w.psi, ulps(v.psi[k], psi_exact(q)));
  }
  return w;
}

TEST(Functions, UnitsInTheLastPlace) {
  const auto x = depths();
  const Worst w = worst(evaluate("auto", x), x);
  std::printf("e^-x %.2f, 1 - e^-x %.2f, phi1 %.2f, psi %.2f ulp\n", w.t, w.opacity, w.phi1, w.psi);
  EXPECT_LE(w.t, 2);
  EXPECT_LE(w.opacity, 2);
  EXPECT_LE(w.phi1, 3);
  EXPECT_LE(w.psi, 24);  // (phi1 - e^-q) / q cancels at q = 1/4: about 1 / (q psi) rounding errors
}

TEST(Functions, OpaqueIsExact) {
  const Values v = evaluate("auto", {708, 1e4, 1e300});
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(v.t[k], 0);
    EXPECT_EQ(v.opacity[k], 1);
  }
}

TEST(Functions, SameBitsOnEveryInstructionSet) {
  const auto x = depths();
  const Values first = evaluate("scalar", x);
  for (const std::string& isa : cpu::usable_isas()) {
    const Values v = evaluate(isa, x);
    for (auto member : {&Values::t, &Values::opacity, &Values::phi1, &Values::psi})
      EXPECT_EQ(std::memcmp((v.*member).data(), (first.*member).data(), x.size() * sizeof(double)), 0) << isa;
  }
}

// Negative controls: the opacity as 1 - t has lost the digits of thin cells; an error of 4 ulp is seen.
TEST(Functions, LostDigitsAreFound) {
  const auto x = depths();
  Values v = evaluate("auto", x);
  for (std::size_t k = 0; k < x.size(); ++k) v.opacity[k] = 1 - v.t[k];
  EXPECT_GT(worst(v, x).opacity, 1e6);
  v.t[6] *= 1 + 4 * 0x1p-52;
  EXPECT_GT(worst(v, x).t, 2);
}

TEST(Functions, UnknownModulesAreNamed) {
  try {
    preintegrated::table_module("/nowhere", "scalar");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("/nowhere/table.scalar.so"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace dvrlab::test
