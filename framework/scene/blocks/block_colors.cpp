#include "framework/scene/blocks/block_colors.h"

#include <algorithm>
#include <cmath>

#include "framework/metric/luv.h"

namespace dvrlab {
namespace {

constexpr double opaque_depth = 40;

/// What is sent and what is let through over black and over white, as CIELUV; each counts half of the square.
std::array<float, 6> seen(const Vector3& sent, const Vector3& through, bool linear) {
  Vector3 over_white;
  for (std::size_t k = 0; k < 3; ++k) over_white[k] = sent[k] + through[k];
  const Vector3 a = luv_of(sent, linear), b = luv_of(over_white, linear);
  std::array<float, 6> r;
  for (std::size_t k = 0; k < 3; ++k) {
    r[k] = float(a[k] * std::sqrt(0.5));
    r[3 + k] = float(b[k] * std::sqrt(0.5));
  }
  return r;
}

std::array<float, 6> slab(const Medium& medium, double v, double thickness, bool linear) {
  for (const OpaqueRange& o : medium.opaque)
    if (o.v0 < o.v1 && v >= o.v0 && v <= o.v1) {
      Vector3 color;
      const double w = std::clamp((v - o.v0) / (o.v1 - o.v0), 0.0, 1.0);
      for (std::size_t k = 0; k < 3; ++k)
        color[k] = o.P[0][k] + o.S[0][k] + w * (o.P[1][k] + o.S[1][k] - o.P[0][k] - o.S[0][k]);
      return seen(color, {0, 0, 0}, linear);
    }
  const auto x = medium.at(v);
  Vector3 sent, through;
  for (int c = 0; c < 3; ++c) {
    const double depth = x[std::size_t(column(Term::tau_l, c))] * thickness;
    const double source =
        x[std::size_t(column(Term::E, c))] + x[std::size_t(column(Term::P, c))] + x[std::size_t(column(Term::S_l, c))];
    through[std::size_t(c)] = std::exp(-depth);
    sent[std::size_t(c)] = source * thickness * (depth > 1e-9 ? -std::expm1(-depth) / depth : 1.0);
  }
  return seen(sent, through, linear);
}

}  // namespace

BlockColors::BlockColors(const ArrangeInput& input, double voxel)
    : lo_(input.lo), scale_((input.entries - 1) / (input.hi - input.lo)), linear_(input.linear) {
  const Medium& m = input.medium;
  surfaces_ = m.terms().surfaces() || !m.dirac.empty() || !m.opaque.empty();
  std::array<double, 6> below{};
  double before = lo_;
  const std::array<float, 6> nothing = seen({0, 0, 0}, {1, 1, 1}, linear_);
  for (int e = 0; e < input.entries; ++e) {
    const double v = lo_ + e / scale_;
    color_.push_back(slab(m, v, voxel, linear_));
    visible_.push_back(color_.back() != nothing);
    if (!surfaces_) continue;
    const auto x = m.at(0.5 * (before + v));
    for (int c = 0; c < 3; ++c) {
      below[std::size_t(c)] += x[std::size_t(column(Term::tau_s, c))] * (v - before);
      below[std::size_t(3 + c)] += x[std::size_t(column(Term::S_s, c))] * (v - before);
    }
    const auto add = [&](double at, const Vector3& depth, const Vector3& color) {
      if (!(at > before || e == 0) || at > v) return;
      for (std::size_t c = 0; c < 3; ++c) {
        below[c] += depth[c];
        below[3 + c] += depth[c] * color[c];
      }
    };
    for (const Dirac& d : m.dirac) add(d.v, d.mu, d.c);
    for (const OpaqueRange& o : m.opaque) {
      Vector3 color;
      for (std::size_t c = 0; c < 3; ++c) color[c] = o.P[0][c] + o.S[0][c];
      if (o.v0 == o.v1) add(o.v0, {opaque_depth, opaque_depth, opaque_depth}, color);
    }
    below_.push_back(below);
    before = v;
  }
}

double BlockColors::surface_square(std::size_t i, std::size_t j) const {
  const auto& a = below_[std::min(i, j)];
  const auto& b = below_[std::max(i, j)];
  Vector3 sent, through;
  bool some = false;
  for (std::size_t c = 0; c < 3; ++c) {
    const double depth = b[c] - a[c], source = b[3 + c] - a[3 + c];
    some = some || depth > 0 || source > 0;
    through[c] = std::exp(-depth);
    sent[c] = source * (depth > 1e-9 ? -std::expm1(-depth) / depth : 1.0);
  }
  if (!some) return 0;
  const std::array<float, 6> x = seen(sent, through, linear_), nothing = seen({0, 0, 0}, {1, 1, 1}, linear_);
  double sum = 0;
  for (std::size_t k = 0; k < 6; ++k) sum += double(x[k] - nothing[k]) * double(x[k] - nothing[k]);
  return sum;
}

}  // namespace dvrlab
