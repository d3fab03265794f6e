#include "tests/support/segment_integral.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dvrlab::test {

namespace {
struct Rule {
  std::array<double, 12> x, w;  // on [0, 1]
};

// Gauss-Legendre, from the roots of the Legendre polynomial.
const Rule& gauss_12() {
  static const Rule rule = [] {
    constexpr int n = 12;
    Rule r;
    for (int i = 0; i < n; ++i) {
      double z = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
      for (int step = 0; step < 100; ++step) {
        double p = 1, before = 0;
        for (int k = 0; k < n; ++k) {
          const double older = before;
          before = p;
          p = ((2 * k + 1) * z * before - k * older) / (k + 1);
        }
        slope = n * (z * p - before) / (z * z - 1);
        const double change = p / slope;
        z -= change;
        if (std::abs(change) < 1e-16) break;
      }
      r.x[std::size_t(i)] = 0.5 * (1 - z);
      r.w[std::size_t(i)] = 1 / ((1 - z * z) * slope * slope);
    }
    return r;
  }();
  return rule;
}

using Quadratic = std::array<double, 3>;
Quadratic operator+(const Quadratic& a, const Quadratic& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Quadratic operator*(double s, const Quadratic& a) { return {s * a[0], s * a[1], s * a[2]}; }
double at(const Quadratic& p, double u) { return p[0] + u * (p[1] + u * p[2]); }
double integral(const Quadratic& p, double u) { return u * (p[0] + u * (p[1] / 2 + u * p[2] / 3)); }

// c(ta + u (tb - ta)) as a polynomial of u.
Quadratic along(const Quadratic& c, double ta, double tb) {
  const double d = tb - ta;
  return {at(c, ta), d * (c[1] + 2 * c[2] * ta), d * d * c[2]};
}

// A piece of the segment inside one interval, or a Dirac (`dirac` set).
struct Piece {
  double va, vb, wa, wb;
  const Dirac* dirac;
};

std::vector<Piece> pieces(const Medium& medium, double v0, double v1) {
  const double lo = std::min(v0, v1), hi = std::max(v0, v1);
  struct Cut {
    double v;
    const Dirac* dirac;
  };
  std::vector<Cut> cuts;
  for (const MediumInterval& i : medium.interval)
    for (double v : {i.v0, i.v1})
      if (v > lo && v < hi) cuts.push_back({v, nullptr});
  for (const Dirac& d : medium.dirac)
    if (d.v > lo && d.v <= hi) cuts.push_back({d.v, &d});
  std::stable_sort(cuts.begin(), cuts.end(),
                   [&](const Cut& a, const Cut& b) { return v1 < v0 ? a.v > b.v : a.v < b.v; });
  std::vector<Piece> r;
  double v = v0, w = 0;
  const auto to = [&](double next) {
    const double wn = next == v1 ? 1.0 : (next - v0) / (v1 - v0);
    if (wn > w) r.push_back({v, next, w, wn, nullptr});
    v = next;
    w = wn;
  };
  for (const Cut& c : cuts) {
    to(c.v);
    if (c.dirac != nullptr) r.push_back({v, v, w, w, c.dirac});
  }
  to(v1);
  return r;
}

const MediumInterval& interval_of(const Medium& medium, double v) {
  std::size_t k = 0;
  while (k + 1 < medium.interval.size() && v >= medium.interval[k].v1) ++k;
  return medium.interval[k];
}
}  // namespace

SegmentIntegral integrate_segment(const Medium& medium, double v0, double v1, double h) {
  SegmentIntegral r;
  const auto parts = pieces(medium, v0, v1);
  for (std::size_t ch = 0; ch < 3; ++ch) {
    double& T = r.T[ch];
    for (const Piece& p : parts) {
      if (p.dirac != nullptr) {
        const double alpha = -std::expm1(-p.dirac->mu[ch]), seen = T * alpha;
        r.S[ch] += seen * p.dirac->c[ch];
        r.S_back[ch] += seen * p.dirac->c[ch] * p.wa;
        r.W[ch] += seen;
        r.W_back[ch] += seen * p.wa;
        T *= std::exp(-p.dirac->mu[ch]);
        continue;
      }
      if (medium.interval.empty()) continue;
      const MediumInterval& i = interval_of(medium, 0.5 * (p.va + p.vb));
      const auto t = [&](double v) { return std::clamp((v - i.v0) / (i.v1 - i.v0), 0.0, 1.0); };
      const double ta = t(p.va), tb = t(p.vb), dw = p.wb - p.wa, dv = std::abs(p.vb - p.va);
      const auto source = [&](Term length, Term surface) {
        return h * dw * along(i.c[std::size_t(column(length, int(ch)))], ta, tb) +
               dv * along(i.c[std::size_t(column(surface, int(ch)))], ta, tb);
      };
      const auto length_only = [&](Term length) {
        return h * dw * along(i.c[std::size_t(column(length, int(ch)))], ta, tb);
      };
      const Quadratic q = source(Term::tau_l, Term::tau_s), E = length_only(Term::E), P = length_only(Term::P),
                      S = source(Term::S_l, Term::S_s), W = source(Term::W_l, Term::W_s);
      const double X = integral(q, 1), seen_depth = std::min(X, 42.0);
      const int panels = std::max(1, static_cast<int>(std::ceil(seen_depth / 2)));
      double ua = 0;
      for (int k = 1; k <= panels; ++k) {
        double ub = 1;
        if (k < panels || seen_depth < X) {  // where the depth is seen_depth k / panels: it grows with u
          double below = ua, above = 1;
          for (int step = 0; step < 80; ++step) {
            ub = 0.5 * (below + above);
            (integral(q, ub) < seen_depth * k / panels ? below : above) = ub;
          }
        }
        for (std::size_t g = 0; g < 12; ++g) {
          const double u = ua + gauss_12().x[g] * (ub - ua);
          const double weight = gauss_12().w[g] * (ub - ua) * T * std::exp(-integral(q, u)), w = p.wa + u * dw;
          r.E[ch] += weight * at(E, u);
          r.P[ch] += weight * at(P, u);
          r.P_back[ch] += weight * at(P, u) * w;
          r.S[ch] += weight * at(S, u);
          r.S_back[ch] += weight * at(S, u) * w;
          r.W[ch] += weight * at(W, u);
          r.W_back[ch] += weight * at(W, u) * w;
        }
        ua = ub;
      }
      T *= std::exp(-X);
    }
  }
  return r;
}

}  // namespace dvrlab::test
