#include "framework/interfaces/medium.h"

#include <algorithm>
#include <cmath>

namespace dvrlab {

namespace {
constexpr const char* term_names[term_count] = {"tau_l", "E", "P", "S_l", "W_l", "tau_s", "S_s", "W_s"};

double value_of(const std::array<double, 3>& p, double t) { return p[0] + t * (p[1] + t * p[2]); }

// The interval that holds v, or the outermost one; t clamped to [0, 1].
const MediumInterval& locate(const Medium& m, double v, bool from_left, double& t) {
  std::size_t k = 0;
  while (k + 1 < m.interval.size() && (from_left ? v > m.interval[k].v1 : v >= m.interval[k].v1)) ++k;
  const MediumInterval& i = m.interval[k];
  t = std::clamp((v - i.v0) / (i.v1 - i.v0), 0.0, 1.0);
  return i;
}

// True if the columns first .. last-1 are 0 on the closed interval [a, b].
bool zero_on(const Medium& m, double a, double b, int first, int last) {
  const auto zero_at = [&](double v, bool from_left) {
    const auto x = m.at(v, from_left);
    return std::all_of(x.begin() + first, x.begin() + last, [](double y) { return y == 0.0; });
  };
  // Values are those of right limits, but a table entry beside a jump may hold either: both must be 0.
  if (!zero_at(a, false) || !zero_at(b, false) || !zero_at(b, true)) return false;
  for (const MediumInterval& i : m.interval) {
    if (!(i.v1 > a && i.v0 < b)) continue;
    for (int c = first; c < last; ++c)
      for (double x : i.c[std::size_t(c)])
        if (x != 0.0) return false;
  }
  return true;
}

bool dirac_in(const Medium& m, double a, double b) {
  return std::any_of(m.dirac.begin(), m.dirac.end(), [&](const Dirac& d) { return d.v >= a && d.v <= b; });
}

bool lit(const OpaqueRange& o) { return o.S != OpaqueRange{}.S || o.W != OpaqueRange{}.W; }

bool opaque_in(const Medium& m, double a, double b, bool only_lit) {
  return std::any_of(m.opaque.begin(), m.opaque.end(),
                     [&](const OpaqueRange& o) { return o.v0 <= b && o.v1 >= a && (!only_lit || lit(o)); });
}
}  // namespace

std::string Terms::text() const {
  std::string r;
  const auto append = [&](const char* name) { r += (r.empty() ? "" : ", ") + std::string(name); };
  for (int t = 0; t < term_count; ++t)
    if (has(static_cast<Term>(t))) append(term_names[t]);
  if (dirac()) append("Dirac");
  if (rgb()) append("RGB extinction");
  return r;
}

std::array<double, medium_columns> Medium::at(double v, bool from_left) const {
  std::array<double, medium_columns> r{};
  if (interval.empty()) return r;
  double t = 0;
  const MediumInterval& i = locate(*this, v, from_left, t);
  for (std::size_t c = 0; c < medium_columns; ++c) r[c] = value_of(i.c[c], t);
  return r;
}

Terms Medium::terms() const {
  Terms r;
  for (const MediumInterval& i : interval) {
    for (int t = 0; t < term_count; ++t)
      for (int ch = 0; ch < 3; ++ch)
        for (double x : i.c[std::size_t(column(static_cast<Term>(t), ch))])
          if (x != 0.0) r.bits |= Terms::bit(static_cast<Term>(t));
    for (Term t : {Term::tau_l, Term::tau_s}) {
      const auto& red = i.c[std::size_t(column(t, 0))];
      if (i.c[std::size_t(column(t, 1))] != red || i.c[std::size_t(column(t, 2))] != red) r.bits |= Terms::rgb_bit;
    }
  }
  if (!dirac.empty()) r.bits |= Terms::dirac_bit;
  for (const Dirac& d : dirac)
    if (d.mu[1] != d.mu[0] || d.mu[2] != d.mu[0]) r.bits |= Terms::rgb_bit;
  return r;
}

bool Medium::glows_without_extinction() const {
  for (const MediumInterval& i : interval)
    for (int ch = 0; ch < 3; ++ch) {
      const auto& tau = i.c[std::size_t(column(Term::tau_l, ch))];
      const auto& E = i.c[std::size_t(column(Term::E, ch))];
      for (const double t : {0.0, 0.5, 1.0})
        if (value_of(tau, t) <= 0 && value_of(E, t) > 0) return true;
    }
  return false;
}

bool Medium::empty(double a, double b) const {
  return zero_on(*this, a, b, 0, medium_columns) && !dirac_in(*this, a, b) && !opaque_in(*this, a, b, false);
}

bool Medium::unshaded(double a, double b) const {
  return zero_on(*this, a, b, column(Term::S_l, 0), column(Term::W_l, 2) + 1) &&
         zero_on(*this, a, b, column(Term::S_s, 0), column(Term::W_s, 2) + 1) && !dirac_in(*this, a, b) &&
         !opaque_in(*this, a, b, true);
}

bool Medium::shaded() const {
  const Terms t = terms();
  return t.has(Term::S_l) || t.has(Term::W_l) || t.has(Term::S_s) || t.has(Term::W_s) || t.dirac() ||
         std::any_of(opaque.begin(), opaque.end(), lit);
}

Medium Medium::split_at(const std::vector<double>& borders) const {
  Medium r = *this;
  for (double v : borders) {
    if (r.interval.empty()) break;
    // The columns are constant outside: a border out there makes a constant interval.
    const auto constant = [&](double v0, double v1, const MediumInterval& from, double t) {
      MediumInterval i{v0, v1, {}};
      for (std::size_t c = 0; c < medium_columns; ++c) i.c[c] = {value_of(from.c[c], t), 0, 0};
      return i;
    };
    if (v < r.interval.front().v0) {
      r.interval.insert(r.interval.begin(), constant(v, r.interval.front().v0, r.interval.front(), 0));
    } else if (v > r.interval.back().v1) {
      r.interval.push_back(constant(r.interval.back().v1, v, r.interval.back(), 1));
    } else {
      const auto whole = std::find_if(r.interval.begin(), r.interval.end(),
                                      [&](const MediumInterval& i) { return v > i.v0 && v < i.v1; });
      if (whole == r.interval.end()) continue;  // it is a border already
      const MediumInterval i = *whole;
      const double t = (v - i.v0) / (i.v1 - i.v0);
      MediumInterval left{i.v0, v, {}}, right{v, i.v1, {}};
      for (std::size_t c = 0; c < medium_columns; ++c) {
        const auto& p = i.c[c];
        left.c[c] = {p[0], p[1] * t, p[2] * t * t};
        right.c[c] = {value_of(p, t), (p[1] + 2 * p[2] * t) * (1 - t), p[2] * (1 - t) * (1 - t)};
      }
      *whole = left;
      r.interval.insert(r.interval.begin() + (whole - r.interval.begin()) + 1, right);
    }
  }
  return r;
}

Medium Medium::rescaled(double slope, double intercept) const {
  Medium r = *this;
  for (MediumInterval& i : r.interval) {
    i.v0 = (i.v0 - intercept) / slope;
    i.v1 = (i.v1 - intercept) / slope;
    if (slope < 0) {  // the interval is passed the other way round: t -> 1 - t
      std::swap(i.v0, i.v1);
      for (auto& p : i.c) p = {p[0] + p[1] + p[2], -p[1] - 2 * p[2], p[2]};
    }
    for (Term t : {Term::tau_s, Term::S_s, Term::W_s})
      for (int ch = 0; ch < 3; ++ch)
        for (double& x : i.c[std::size_t(column(t, ch))]) x *= std::abs(slope);
  }
  for (Dirac& d : r.dirac) d.v = (d.v - intercept) / slope;
  for (OpaqueRange& o : r.opaque) {
    o.v0 = (o.v0 - intercept) / slope;
    o.v1 = (o.v1 - intercept) / slope;
    if (slope < 0) {
      std::swap(o.v0, o.v1);
      for (auto* ends : {&o.P, &o.S, &o.W}) std::swap((*ends)[0], (*ends)[1]);
    }
  }
  if (slope < 0) {
    std::reverse(r.interval.begin(), r.interval.end());
    std::reverse(r.dirac.begin(), r.dirac.end());
  }
  return r;
}

}  // namespace dvrlab
