// The closed form that Williams and Max 1992 print in section 3.3, with both signs that its square root of q2 < 0 may
// have: the principal branches are right, "the i cancels" is not.
#include <complex>
#include <cstdio>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

using Complex = std::complex<double>;

/// Erfi by its series, which holds for every complex argument; 14 digits for those of this test, |z| < 2.1.
Complex erfi(Complex z) {
  Complex sum = 0, term = z;
  for (int n = 0; n < 80; term *= z * z / double(++n)) sum += term / double(2 * n + 1);
  return 2 / std::sqrt(M_PI) * sum;
}

enum class Root { principal, cancelled };

/// Density rho0 + drho t and chromaticity kappa0 + dkappa t, t from 0 at the back to 1 at the eye's end.
struct Interval {
  double rho0, drho, kappa0, dkappa;
};

/// The paper's expression for the light of an interval, letter by letter.
double printed(const Interval& s, Root root) {
  const double q1 = s.rho0, q2 = s.drho, q3 = s.kappa0 * s.rho0, q4 = s.kappa0 * s.drho + s.dkappa * s.rho0,
               q5 = s.dkappa * s.drho, t0 = 0, t1 = 1;
  const auto argument = [&](double t) {
    const Complex z = (q1 + q2 * t) / std::sqrt(Complex(2 * q2));
    return root == Root::principal ? z : std::conj(z);  // i b with b > 0, as the text reads
  };
  const double ends =
      (q2 * q4 - q1 * q5 + q2 * q5 * t1) / (q2 * q2) -
      (q2 * q4 - q1 * q5 + q2 * q5 * t0) / (q2 * q2) * std::exp((t0 - t1) * (2 * q1 + q2 * t0 + q2 * t1) / 2);
  const Complex factor = std::sqrt(M_PI / 2) * (q2 * q2 * q3 - q1 * q2 * q4 + q1 * q1 * q5 - q2 * q5) /
                         (std::pow(Complex(q2), 2.5) * std::exp((q1 + q2 * t1) * (q1 + q2 * t1) / (2 * q2)));
  return ends + (factor * (erfi(argument(t1)) - erfi(argument(t0)))).real();
}

/// The same interval by `exact` in fp64; the eye looks at its end first.
double ours(const Interval& s) {
  json config = ray_config(ramp_field(1, 0, 1), 1, 1);
  config["optical_model"] = {{"type", "volume_density"},
                             {"tf", "nodes"},
                             {"density", {{0, s.rho0}, {1, s.rho0 + s.drho}}},
                             {"chromaticity", {{0, s.kappa0}, {1, s.kappa0 + s.dkappa}}}};
  config["estimator"] = {{"type", "exact"}};
  config["precision"] = "fp64";
  return render(config, {"cpu fp64", {{"type", "cpu"}}}).image.radiance(0);
}

// Figure 2's first density, 5 - 3 s, and its mirror image. The chromaticity falls: were it the paper's constant 1.7,
// the term with Erfi would be 0 and its sign would not matter.
TEST(ClosedForm, OfWilliamsAndMaxNeedsThePrincipalBranches) {
  for (const Interval& s : {Interval{5, -3, 1.7, -1.4}, Interval{5, -3, 0.3, 1.4}, Interval{2, 3, 1.7, -1.4}}) {
    const double right = printed(s, Root::principal), wrong = printed(s, Root::cancelled), found = ours(s);
    std::printf("q2 = %g: ours %.12f, printed %.1e off, with the i cancelled %.2f off\n", s.drho, found,
                std::abs(right - found), std::abs(wrong - found));
    EXPECT_NEAR(found, right, 1e-11);
    if (s.drho < 0)
      EXPECT_GT(std::abs(wrong - found), 0.5) << "negative control: the other sign must miss";
    else
      EXPECT_EQ(wrong, right) << "a real root has one sign";
  }
  EXPECT_NEAR(ours({5, -3, 1.7, -1.4}), 0.7307423206234, 1e-11);
  EXPECT_NEAR(printed({5, -3, 1.7, -1.4}, Root::cancelled), -0.2334134242593, 1e-11) << "light below zero";
}

TEST(ClosedForm, ConstantChromaticityHidesTheSign) {
  const Interval figure_2 = {5, -3, 1.7, 0};
  for (const Root root : {Root::principal, Root::cancelled})
    EXPECT_NEAR(printed(figure_2, root), 1.7 * (1 - std::exp(-3.5)), 1e-12);
}

}  // namespace
}  // namespace dvrlab::test
