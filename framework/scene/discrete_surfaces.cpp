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

}  // namespace

void add_discrete_surfaces(const Medium& medium, bool fold_shaded, KernelUnit& unit) {
  unit.uniforms.push_back(Uniform::constant_integer("medium_diracs", static_cast<int>(medium.dirac.size())));
  unit.uniforms.push_back(Uniform::constant_integer("medium_opaques", static_cast<int>(medium.opaque.size())));
  std::vector<double> rows = dirac_rows(medium.dirac);
  const std::vector<double> ranges = opaque_rows(medium.opaque, fold_shaded);
  rows.insert(rows.end(), ranges.begin(), ranges.end());
  unit.buffers.push_back(vec4_buffer("medium_discrete", std::move(rows)));
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
