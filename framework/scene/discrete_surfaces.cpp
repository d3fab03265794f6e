#include "framework/scene/discrete_surfaces.h"

#include <algorithm>
#include <cmath>

#include "framework/interfaces/error.h"
#include "framework/interfaces/transfer_function.h"
#include "framework/scene/buffers.h"

namespace dvrlab {
namespace {

void append(std::vector<double>& values, double x, double y, double z, double w) {
  values.insert(values.end(), {x, y, z, w});
}
void append(std::vector<double>& values, const Vector3& a) { append(values, a[0], a[1], a[2], 0); }

std::vector<double> dirac_rows(const std::vector<Dirac>& diracs) {
  std::vector<double> rows;
  for (const Dirac& d : diracs) {
    Vector3 alpha, color, depth_color;
    for (std::size_t c = 0; c < 3; ++c) {
      alpha[c] = -std::expm1(-d.mu[c]);
      color[c] = alpha[c] * d.c[c];
      depth_color[c] = d.mu[c] * d.c[c];
    }
    append(rows, d.v, 1 - alpha[0], 1 - alpha[1], 1 - alpha[2]);
    append(rows, color);
    append(rows, alpha);
    append(rows, depth_color);
    append(rows, d.mu);
  }
  return rows;
}

Vector3 difference(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// 0 where the colour is constant: an isosurface, or a range that reaches beyond every value.
double inverse_width(const OpaqueRange& o) {
  const double width = o.v1 - o.v0;
  return width > 0 && width < 1e30 ? 1.0 / width : 0.0;
}

std::vector<double> opaque_rows(const std::vector<OpaqueRange>& ranges, bool fold_shaded) {
  std::vector<double> rows;
  for (const OpaqueRange& o : ranges) {
    std::array<Vector3, 2> P = o.P;
    for (std::size_t e = 0; e < 2 && fold_shaded; ++e)
      for (std::size_t c = 0; c < 3; ++c) P[e][c] += o.S[e][c];
    append(rows, o.v0, o.v1, inverse_width(o), o.v0 == o.v1 ? 1 : 0);
    for (const auto& ends : {P, o.S, o.W}) {
      append(rows, ends[0]);
      append(rows, difference(ends[1], ends[0]));
    }
  }
  return rows;
}

// Tau_s of a pulse over [v - width / 2, v + width / 2] whose integral is mu.
Curve pulse(const Dirac& d, double width) {
  const Vector3 top{2 * d.mu[0] / width, 2 * d.mu[1] / width, 2 * d.mu[2] / width}, zero{0, 0, 0};
  return Curve(std::vector<Node>{{d.v - width / 2, zero}, {d.v, top}, {d.v + width / 2, zero}});
}

// Colours of a range at v, of the whole range's linear ones.
Vector3 color_at(const OpaqueRange& o, const std::array<Vector3, 2>& ends, double v) {
  const double u = (v - o.v0) * inverse_width(o);
  Vector3 r;
  for (std::size_t c = 0; c < 3; ++c) r[c] = ends[0][c] + (ends[1][c] - ends[0][c]) * u;
  return r;
}

OpaqueRange part_of(const OpaqueRange& o, double v0, double v1) {
  OpaqueRange r;
  r.v0 = v0;
  r.v1 = v1;
  r.P = {color_at(o, o.P, v0), color_at(o, o.P, v1)};
  r.S = {color_at(o, o.S, v0), color_at(o, o.S, v1)};
  r.W = {color_at(o, o.W, v0), color_at(o, o.W, v1)};
  return r;
}

// Adds what of `range` lies outside the ranges that are there.
void add_outside(std::vector<OpaqueRange>& kept, const OpaqueRange& range) {
  std::vector<OpaqueRange> parts{range};
  for (const OpaqueRange& k : kept) {
    if (k.v0 == k.v1) continue;
    std::vector<OpaqueRange> left;
    for (const OpaqueRange& p : parts) {
      if (p.v1 < k.v0 || p.v0 > k.v1) {
        left.push_back(p);
        continue;
      }
      if (p.v0 < k.v0) left.push_back(part_of(range, p.v0, k.v0));
      if (p.v1 > k.v1) left.push_back(part_of(range, k.v1, p.v1));
    }
    parts = std::move(left);
  }
  kept.insert(kept.end(), parts.begin(), parts.end());
}

// Prediction (Lee and Shin 2013, section 4.2) over the bins of the medium's table: the lower end of the first range
// that reaches into the bin or lies above it, the upper end of the last one that begins in it or below, and both their
// numbers. One bin of margin covers rounding.
std::vector<double> prediction_of(const std::vector<OpaqueRange>& ranges, const MediumTableOptions& o) {
  constexpr double nowhere = 3e38;
  std::vector<double> next;
  const int last = static_cast<int>(ranges.size()) - 1;
  const auto edge = [&](int b) { return o.lo + (o.hi - o.lo) * b / (o.entries - 1); };
  int up = 0, down = 0;
  for (int b = 0; b < o.entries && last >= 0; ++b) {  // the coordinate of the last entry is a bin of its own
    // The outermost bins hold what lies beyond them, too.
    const double below = b > 0 ? edge(b - 1) : -nowhere, above = b + 2 > o.entries ? nowhere : edge(b + 2);
    while (up < last && ranges[static_cast<std::size_t>(up)].v1 < below) ++up;
    while (down < last && ranges[static_cast<std::size_t>(down) + 1].v0 <= above) ++down;
    const OpaqueRange &first = ranges[static_cast<std::size_t>(up)], &second = ranges[static_cast<std::size_t>(down)];
    next.insert(next.end(), {first.v1 < below ? nowhere : first.v0, second.v0 > above ? -nowhere : second.v1,
                             static_cast<double>(up), static_cast<double>(down)});
  }
  return next;
}

struct FiniteRange : OpaqueRange {
  bool beyond_low, beyond_high;  // it has no end there
};

// Beyond the outermost border the columns are constant: a border near by says the same as one at infinity.
std::vector<FiniteRange> finite(const Medium& medium) {
  const auto [front, back] =
      medium.interval.empty() ? std::pair{0.0, 1.0} : std::pair{medium.interval.front().v0, medium.interval.back().v1};
  std::vector<FiniteRange> ranges;
  for (const OpaqueRange& o : disjoint(medium.opaque)) {
    FiniteRange r{o, o.v0<-1e30, o.v1> 1e30};
    if (r.beyond_low) r.v0 = std::min(front, o.v1) - 1;
    if (r.beyond_high) r.v1 = std::max(back, o.v0) + 1;
    ranges.push_back(r);
  }
  return ranges;
}

}  // namespace

std::vector<OpaqueRange> disjoint(const std::vector<OpaqueRange>& ranges) {
  std::vector<OpaqueRange> kept;
  for (const OpaqueRange& r : ranges)
    if (r.v0 < r.v1) add_outside(kept, r);
  for (const OpaqueRange& r : ranges) {
    const bool known =
        std::any_of(kept.begin(), kept.end(), [&](const OpaqueRange& k) { return r.v0 >= k.v0 && r.v0 <= k.v1; });
    if (r.v0 == r.v1 && !known) kept.push_back(r);
  }
  std::sort(kept.begin(), kept.end(), [](const OpaqueRange& a, const OpaqueRange& b) { return a.v0 < b.v0; });
  return kept;
}

void add_discrete_surfaces(const Medium& medium, const MediumTableOptions& options, OpaquePrediction prediction,
                           KernelUnit& unit) {
  const std::vector<OpaqueRange> opaque = disjoint(medium.opaque);
  unit.uniforms.push_back(Uniform::constant_integer("medium_diracs", static_cast<int>(medium.dirac.size())));
  unit.uniforms.push_back(Uniform::constant_integer("medium_opaques", static_cast<int>(opaque.size())));
  unit.uniforms.push_back(
      Uniform::constant_integer("medium_prediction", prediction == OpaquePrediction::published ? 1 : 0));
  std::vector<double> rows = dirac_rows(medium.dirac);
  const std::vector<double> ranges = opaque_rows(opaque, options.fold_shaded);
  rows.insert(rows.end(), ranges.begin(), ranges.end());
  unit.buffers.push_back(vec4_buffer("medium_discrete", std::move(rows)));
  unit.buffers.push_back(vec4_buffer("medium_opaque_next", prediction_of(opaque, options)));
}

Medium continued_into_opaque(const Medium& medium) {
  if (medium.opaque.empty() || medium.interval.empty()) return medium;
  const std::vector<FiniteRange> opaque = finite(medium);
  std::vector<double> borders;
  for (const FiniteRange& o : opaque) borders.insert(borders.end(), {o.v0, 0.5 * (o.v0 + o.v1), o.v1});
  Medium r = medium.split_at(borders);
  for (const FiniteRange& o : opaque) {
    if (o.v0 == o.v1) continue;
    const double middle = 0.5 * (o.v0 + o.v1);
    const auto below = medium.at(o.v0, true), above = medium.at(o.v1);
    for (MediumInterval& i : r.interval) {
      if (i.v0 < o.v0 || i.v1 > o.v1) continue;
      // Nothing lies in front of a range that has no end there.
      const bool low = o.beyond_high || (!o.beyond_low && i.v1 <= middle);
      for (std::size_t c = 0; c < medium_columns; ++c) i.c[c] = {low ? below[c] : above[c], 0, 0};
    }
  }
  return r;
}

Medium without_opaque_values(const Medium& medium, double extinction) {
  constexpr double surface_depth = 16.6;  // docs/math, section 0
  if (medium.opaque.empty()) return medium;
  const std::vector<FiniteRange> opaque = finite(medium);
  std::vector<double> borders;
  for (const FiniteRange& o : opaque) borders.insert(borders.end(), {o.v0, o.v1});
  Medium r = medium;
  if (r.interval.empty()) r.interval.push_back({borders.front(), borders.back() + 1, {}});
  r = r.split_at(borders);
  for (const FiniteRange& o : opaque) {
    if (o.v0 == o.v1) {
      const Vector3 depth{surface_depth, surface_depth, surface_depth};
      Vector3 color;
      for (std::size_t c = 0; c < 3; ++c) color[c] = o.P[0][c] + o.S[0][c];
      r.dirac.push_back({o.v0, depth, color});
      continue;
    }
    for (MediumInterval& i : r.interval) {
      if (i.v0 < o.v0 || i.v1 > o.v1) continue;
      i.c = {};
      for (int c = 0; c < 3; ++c) {
        const auto ch = static_cast<std::size_t>(c);
        i.c[static_cast<std::size_t>(column(Term::tau_l, c))] = {extinction, 0, 0};
        for (const auto& [term, ends] : {std::pair{Term::P, &o.P}, {Term::S_l, &o.S}, {Term::W_l, &o.W}}) {
          const double at0 = extinction * color_at(o, *ends, i.v0)[ch], at1 = extinction * color_at(o, *ends, i.v1)[ch];
          i.c[static_cast<std::size_t>(column(term, c))] = {at0, at1 - at0, 0};
        }
      }
    }
  }
  std::sort(r.dirac.begin(), r.dirac.end(), [](const Dirac& a, const Dirac& b) { return a.v < b.v; });
  r.opaque.clear();
  return r;
}

Medium with_pulses(const Medium& medium, double width) {
  if (!(width > 0)) throw InputError("a pulse in place of a Dirac term must be wider than 0");
  std::vector<Curve> pulses;
  for (const Dirac& d : medium.dirac) pulses.push_back(pulse(d, width));
  Medium result = medium.split_at([&] {
    std::vector<double> breaks;
    for (const Curve& p : pulses)
      for (double v : p.breaks()) breaks.push_back(v);
    return breaks;
  }());
  MediumBuilder builder(std::move(result));
  for (std::size_t k = 0; k < pulses.size(); ++k) {
    const Curve color(medium.dirac[k].c);
    builder.add(Term::tau_s, pulses[k]);
    builder.add_product(Term::S_s, color, pulses[k]);
    builder.add(Term::W_s, pulses[k]);
  }
  result = builder.take();
  result.dirac.clear();
  for (OpaqueRange& r : result.opaque) {
    if (r.v0 != r.v1) continue;
    r.v0 -= width / 2;
    r.v1 += width / 2;
  }
  return result;
}

}  // namespace dvrlab
