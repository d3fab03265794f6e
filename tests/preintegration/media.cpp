#include "tests/preintegration/media.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "tests/support/reference.h"

namespace dvrlab::test {

namespace {
using nlohmann::json;

// Nodes "tau linear, colour linear": their product on each interval, in t.
struct Pair {
  json depth, color;
  Term extinction, source;
};

// The limits of a node function at both ends of [a, b].
std::pair<double, double> ends(const json& nodes, double a, double b, std::size_t ch) {
  const double third = (b - a) / 3;  // linear inside: two inner values give the limits at the ends
  const double x = nodes_at(nodes, a + third)[ch], y = nodes_at(nodes, b - third)[ch];
  return {2 * x - y, 2 * y - x};
}

json extinction_nodes(json opacity, double standard) {
  for (json& node : opacity) node[1] = -std::log1p(-node[1].get<double>()) / standard;
  return opacity;
}

Medium medium_of(const std::vector<Pair>& pairs) {
  std::set<double> at;
  for (const Pair& p : pairs)
    for (const json& nodes : {p.depth, p.color})
      for (const json& n : nodes) at.insert(n[0].get<double>());
  Medium m;
  for (auto a = at.begin(); a != at.end() && std::next(a) != at.end(); ++a) {
    MediumInterval i{*a, *std::next(a), {}};
    for (const Pair& p : pairs) {
      for (std::size_t ch = 0; ch < 3; ++ch) {
        const auto [x0, x1] = ends(p.depth, i.v0, i.v1, ch);
        const auto [c0, c1] = ends(p.color, i.v0, i.v1, ch);
        auto& tau = i.c[std::size_t(column(p.extinction, int(ch)))];
        auto& source = i.c[std::size_t(column(p.source, int(ch)))];
        tau = {tau[0] + x0, tau[1] + x1 - x0, 0};
        source = {source[0] + x0 * c0, source[1] + x0 * (c1 - c0) + c0 * (x1 - x0), source[2] + (x1 - x0) * (c1 - c0)};
      }
    }
    m.interval.push_back(i);
  }
  return m;
}
}  // namespace

Medium golden_medium(const json& golden) {
  const json& p = golden.at("params");
  if (golden.at("model") == "absorption_emission")
    return medium_of({{p.at("tau"), p.at("color"), Term::tau_l, Term::P}});
  std::vector<Pair> pairs;
  if (p.contains("a_s"))
    pairs.push_back({extinction_nodes(p.at("a_s"), p.at("dv_std")), p.at("c_s"), Term::tau_s, Term::S_s});
  if (p.contains("a_ps"))
    pairs.push_back({extinction_nodes(p.at("a_ps"), p.at("dl_std")), p.at("c_ps"), Term::tau_l, Term::P});
  Medium m = medium_of(pairs);
  for (const json& d : p.value("diracs", json::array())) {
    const double mu = -std::log1p(-d.at("alpha").get<double>());
    m.dirac.push_back({d.at("v").get<double>(), {mu, mu, mu}, d.at("color").get<Vector3>()});
  }
  return m;
}

Medium random_medium(std::uint32_t seed, const RandomMedium& what) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> at = {0.1, 0.9};
  for (int k = 0; k < 8; ++k) at.push_back(0.1 + 0.8 * uniform(random));
  std::sort(at.begin(), at.end());
  Medium m;
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    MediumInterval i{at[k], at[k + 1], {}};
    const bool empty = uniform(random) < 0.2;
    const bool opaque = what.opaque_spikes && k % 4 == 1;
    for (int c = 0; c < medium_columns && !empty; ++c) {
      const bool extinction = c / 3 == int(Term::tau_l) || c / 3 == int(Term::tau_s);
      if (extinction && !what.rgb && c % 3 != 0) {
        i.c[std::size_t(c)] = i.c[std::size_t(c - c % 3)];
        continue;
      }
      // Bernstein coefficients >= 0: the polynomial is not negative.
      double b[3];
      for (double& x : b) x = uniform(random) * (extinction ? 4.0 : 2.0) * (extinction && opaque ? 3e5 : 1.0);
      i.c[std::size_t(c)] = {b[0], 2 * (b[1] - b[0]), b[0] - 2 * b[1] + b[2]};
    }
    m.interval.push_back(i);
  }
  for (int k = 0; k < what.diracs; ++k) {
    Dirac d{uniform(random), {}, {}};
    if (k == 1) d.v = 0.25;
    if (k == 2) d.v = 0.2499;
    for (std::size_t ch = 0; ch < 3; ++ch) {
      d.mu[ch] = what.rgb || ch == 0 ? 2 * uniform(random) : d.mu[0];
      d.c[ch] = uniform(random);
    }
    m.dirac.push_back(d);
  }
  return m;
}

}  // namespace dvrlab::test
