#include "framework/scene/light_extinction.h"

#include <algorithm>

#include "framework/scene/buffers.h"

namespace dvrlab {
namespace {

constexpr double opaque_depth = 40, opaque_per_voxel = 4000;

bool inside_opaque(const Medium& medium, double v) {
  return std::any_of(medium.opaque.begin(), medium.opaque.end(),
                     [&](const OpaqueRange& r) { return r.v0 < r.v1 && v >= r.v0 && v <= r.v1; });
}

/// Integral of a column over [a, b] of one interval.
double integral(const MediumInterval& i, std::size_t column, double a, double b) {
  const double width = i.v1 - i.v0;
  const auto below = [&](double v) {
    const double t = (v - i.v0) / width;
    return t * (i.c[column][0] + t * (i.c[column][1] / 2 + t * i.c[column][2] / 3)) * width;
  };
  return below(b) - below(a);
}

/// Integral of tau_s from the first entry's value to each of the others; outside the intervals it is constant.
std::vector<double> surfaces_below(const Medium& medium, const std::vector<double>& value, int channel) {
  const auto column_ = std::size_t(column(Term::tau_s, channel));
  std::vector<double> sum{0};
  for (std::size_t e = 1; e < value.size(); ++e) {
    double part = 0, a = value[e - 1];
    const double b = value[e];
    if (!medium.interval.empty()) {
      const double first = medium.interval.front().v0, last = medium.interval.back().v1;
      if (a < first) part += (std::min(b, first) - a) * medium.at(first)[column_];
      if (b > last) part += (b - std::max(a, last)) * medium.at(last)[column_];
      for (const MediumInterval& i : medium.interval) {
        const double from = std::max(a, i.v0), to = std::min(b, i.v1);
        if (to > from) part += integral(i, column_, from, to);
      }
    }
    sum.push_back(sum.back() + part);
  }
  return sum;
}

}  // namespace

Vector3 largest_extinction(const Medium& medium, const MediumTableOptions& options) {
  Vector3 largest{0, 0, 0};
  for (int e = 0; e < options.entries; ++e) {
    const auto columns = medium.at(options.lo + (options.hi - options.lo) * e / (options.entries - 1));
    for (int c = 0; c < 3; ++c)
      largest[std::size_t(c)] = std::max(largest[std::size_t(c)], columns[std::size_t(column(Term::tau_l, c))]);
  }
  return largest;
}

void add_light_extinction(const Medium& medium, const MediumTableOptions& options, double scale, double voxel,
                          KernelUnit& unit) {
  const int channels = medium.terms().rgb() ? 3 : 1;
  std::vector<double> value, tau, surface, dirac;
  for (int e = 0; e < options.entries; ++e)
    value.push_back(options.lo + (options.hi - options.lo) * e / (options.entries - 1));
  for (int c = 0; c < channels; ++c) {
    for (const double v : value)
      tau.push_back(inside_opaque(medium, v) ? opaque_per_voxel / voxel
                                             : scale * medium.at(v)[std::size_t(column(Term::tau_l, c))]);
    for (const double depth : surfaces_below(medium, value, c)) surface.push_back(scale * depth);
  }
  for (const Dirac& d : medium.dirac)
    dirac.insert(dirac.end(), {d.v, scale * d.mu[0], scale * d.mu[1], scale * d.mu[2]});
  for (const OpaqueRange& r : medium.opaque)
    for (const double v : r.v0 < r.v1 ? std::vector{r.v0, r.v1} : std::vector{r.v0})
      dirac.insert(dirac.end(), {v, opaque_depth, opaque_depth, opaque_depth});
  const bool surfaces = medium.terms().has(Term::tau_s) || !dirac.empty();
  unit.uniforms.insert(unit.uniforms.end(),
                       {Uniform::real("light_tau_lo", options.lo),
                        Uniform::real("light_tau_scale", (options.entries - 1) / (options.hi - options.lo)),
                        Uniform::integer("light_tau_entries", options.entries),
                        Uniform::constant_integer("light_surfaces", surfaces ? 1 : 0),
                        Uniform::constant_integer("light_diracs", int(dirac.size() / 4))});
  unit.buffers.push_back(real_buffer("light_tau", std::move(tau)));
  unit.buffers.push_back(real_buffer("light_surface", std::move(surface)));
  unit.buffers.push_back(vec4_buffer("light_dirac", std::move(dirac)));
}

}  // namespace dvrlab
