#include "plugins/estimator/preintegrated/definition.h"

#include <cmath>
#include <cstdlib>

namespace dvrlab::preintegrated {

namespace {
double phi1(double q) { return q == 0 ? 1 : -std::expm1(-q) / q; }

// int_0^1 u^n e^-qu du
double psi(double q, int n) {
  if (std::abs(q) > 0.5) {
    double value = phi1(q);
    for (int k = 1; k <= n; ++k) value = (k * value - std::exp(-q)) / q;
    return value;
  }
  double sum = 0, term = 1;
  for (int k = 0; k < 24; ++k) {
    sum += term / (k + n + 1);
    term *= -q / (k + 1);
  }
  return sum;
}

// A part of a segment in the monoid (B4); D, D2, D3 are weighted with the position in cells from the front and its
// powers.
struct Triple {
  double T = 1, C = 0, D = 0, length = 0, D2 = 0, D3 = 0;
};
Triple then(const Triple& a, const Triple& b) {
  const double n = a.length;
  return {a.T * b.T,
          a.C + a.T * b.C,
          a.D + a.T * (b.D + n * b.C),
          n + b.length,
          a.D2 + a.T * (b.D2 + n * (2 * b.D + n * b.C)),
          a.D3 + a.T * (b.D3 + n * (3 * b.D2 + n * (3 * b.D + n * b.C)))};
}

struct Source {
  double length = 0, surface = 0;
};
Source source_of(const Cells& cells, const SourceColumn& s, std::size_t k) {
  const auto get = [&](bool wanted, Term t) {
    return wanted ? cells.integral[std::size_t(column(t, s.channel))][k] : 0;
  };
  return {get(s.E, Term::E) + get(s.P, Term::P) + get(s.S, Term::S_l) + get(s.W, Term::W_l),
          get(s.S, Term::S_s) + get(s.W, Term::W_s)};
}
double dirac_source(const SourceColumn& s, const CellDirac& d) {
  return (s.S ? d.c[std::size_t(s.channel)] : 0) + (s.W ? 1 : 0);
}

Triple homogeneous(double length, double q, double G) {
  q *= length;
  G *= length;
  return {std::exp(-q),
          G * phi1(q),
          length * G * psi(q, 1),
          length,
          length * length * G * psi(q, 2),
          length * length * length * G * psi(q, 3)};
}

Triple cell(const Cells& cells, const SourceColumn& s, int e, std::size_t k, double h_m, bool reversed, double sign) {
  const Source g = source_of(cells, s, k);
  const double q = h_m * cells.integral[std::size_t(column(Term::tau_l, e))][k] +
                   sign * cells.integral[std::size_t(column(Term::tau_s, e))][k];
  const double G = h_m * g.length + sign * g.surface;
  std::vector<CellDirac> inside;
  for (const CellDirac& d : cells.dirac)
    if (d.cell == int(k)) inside.push_back(d);
  if (reversed) {
    inside = {inside.rbegin(), inside.rend()};
    for (CellDirac& d : inside) d.u = 1 - d.u;
  }
  Triple r;
  for (const CellDirac& d : inside) {
    r = then(r, homogeneous(d.u - r.length, q, G));
    const double mu = sign * d.mu[std::size_t(e)];  // in tables a Dirac term is a step of the integral over |dv|
    r = then(r, {std::exp(-mu), -std::expm1(-mu) * dirac_source(s, d), 0, 0});
  }
  return then(r, homogeneous(1 - r.length, q, G));
}

Entry diagonal(const Cells& cells, const SourceColumn& s, int e, double h, std::size_t i) {
  const auto get = [&](bool wanted, Term t) {
    return wanted ? cells.at_value[std::size_t(column(t, s.channel))][i] : 0;
  };
  const double q = h * cells.at_value[std::size_t(column(Term::tau_l, e))][i];
  const double G = h * (get(s.E, Term::E) + get(s.P, Term::P) + get(s.S, Term::S_l) + get(s.W, Term::W_l));
  return {std::exp(-q), G * phi1(q), G * psi(q, 1), G * psi(q, 2), G * psi(q, 3)};
}
}  // namespace

Entry defined_entry(const Cells& cells, const SourceColumn& s, int e, double h, int i, int j, double surface_sign) {
  if (i == j) return diagonal(cells, s, e, h, std::size_t(i));
  const int m = std::abs(j - i);
  Triple r;
  for (int k = 0; k < m; ++k)
    r = then(r, cell(cells, s, e, std::size_t(j > i ? i + k : i - 1 - k), h / m, j < i, surface_sign));
  const double n = m;
  return {r.T, r.C, r.D / n, r.D2 / (n * n), r.D3 / (n * n * n)};
}

std::vector<Entry> published_slide(const Cells& cells, const SourceColumn& s, int e, double h, int m, bool descending) {
  const int count = cells.grid.cells();
  const auto at = [&](int k) {
    return cell(cells, s, e, std::size_t(descending ? count - 1 - k : k), h / m, descending, 1);
  };
  Triple w;
  for (int k = 0; k < m; ++k) w = then(w, at(k));
  std::vector<Entry> entries{{w.T, w.C, w.D / m}};
  for (int i = 0; i + m < count; ++i) {
    const Triple front = at(i), next = at(i + m);
    const double rest = (w.C - front.C) / front.T, R = w.T / front.T;
    w.D = (w.D - front.D) / front.T - rest + R * ((m - 1) * next.C + next.D);
    w.C = rest + R * next.C;
    w.T = R * next.T;
    entries.push_back({w.T, w.C, w.D / m});
  }
  return entries;
}

Approximation approximate_entry(const Cells& cells, const SourceColumn& s, int e, double h, int i, int j) {
  const int m = std::abs(j - i);
  if (m == 0) {
    const double q = h * cells.at_value[std::size_t(column(Term::tau_l, e))][std::size_t(i)];
    return {defined_entry(cells, s, e, h, i, i).C, q};
  }
  double Q = 0, G = 0;
  for (int k = std::min(i, j); k < std::max(i, j); ++k) {
    const Source g = source_of(cells, s, std::size_t(k));
    Q += h / m * cells.integral[std::size_t(column(Term::tau_l, e))][std::size_t(k)] +
         cells.integral[std::size_t(column(Term::tau_s, e))][std::size_t(k)];
    G += h / m * g.length + g.surface;
    for (const CellDirac& d : cells.dirac) {
      if (d.cell != k) continue;
      Q += d.mu[std::size_t(e)];
      G += d.mu[std::size_t(e)] * dirac_source(s, d);
    }
  }
  return {G * phi1(Q), Q};
}

}  // namespace dvrlab::preintegrated
