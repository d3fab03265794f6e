#include "framework/interfaces/transfer_function.h"

#include <algorithm>
#include <cmath>

#include "framework/interfaces/error.h"

namespace dvrlab {

namespace {
Vector3 lerp(const Vector3& a, const Vector3& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}
}  // namespace

Vector3 Curve::at(double v, bool from_left) const {
  // The first node behind v: strictly greater for the value (right limit), not less for the limit from the left.
  const auto behind =
      from_left
          ? std::lower_bound(nodes_.begin(), nodes_.end(), v, [](const Node& n, double x) { return n.value < x; })
          : std::upper_bound(nodes_.begin(), nodes_.end(), v, [](double x, const Node& n) { return x < n.value; });
  if (behind == nodes_.begin()) return nodes_.front().x;
  if (behind == nodes_.end()) return nodes_.back().x;
  const Node& a = *(behind - 1);
  const Node& b = *behind;
  return lerp(a.x, b.x, (v - a.value) / (b.value - a.value));
}

std::vector<double> Curve::breaks() const {
  std::vector<double> r;
  for (const Node& n : nodes_)
    if (r.empty() || n.value > r.back()) r.push_back(n.value);
  return r;
}

void require_amount(const ParameterSet& p, const char* color, const char* amount) {
  if (!p.is_null(color) && p.is_null(amount))
    throw InputError(p.path_of(color) + ": colours nothing without " + amount + "; give both or neither");
}

Curve color_curve(const Nodes& nodes, const ModelContext& context) {
  Curve color(nodes);
  if (context.linear_color)
    for (Node& n : color.nodes()) std::transform(n.x.begin(), n.x.end(), n.x.begin(), display_to_linear);
  return color;
}

double display_to_linear(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

MediumBuilder::MediumBuilder(const std::vector<const Curve*>& curves) {
  std::vector<double> border;
  for (const Curve* c : curves)
    for (double v : c->breaks()) border.push_back(v);
  std::sort(border.begin(), border.end());
  border.erase(std::unique(border.begin(), border.end()), border.end());
  // Constant intervals outside, so that a jump at the first or last node is a change between neighbours too.
  border.insert(border.begin(), border.front() - 1.0);
  border.push_back(border.back() + 1.0);
  for (std::size_t k = 0; k + 1 < border.size(); ++k) medium_.interval.push_back({border[k], border[k + 1], {}});
}

void MediumBuilder::add(Term term, const Curve& a, double factor) {
  for (MediumInterval& interval : medium_.interval) {
    const Vector3 a0 = a.at(interval.v0), a1 = a.at(interval.v1, true);
    for (int c = 0; c < 3; ++c) {
      auto& poly = interval.c[std::size_t(column(term, c))];
      poly[0] += factor * a0[std::size_t(c)];
      poly[1] += factor * (a1[std::size_t(c)] - a0[std::size_t(c)]);
    }
  }
}

void MediumBuilder::add_product(Term term, const Curve& a, const Curve& b) {
  for (MediumInterval& interval : medium_.interval) {
    const Vector3 a0 = a.at(interval.v0), a1 = a.at(interval.v1, true);
    const Vector3 b0 = b.at(interval.v0), b1 = b.at(interval.v1, true);
    for (std::size_t c = 0; c < 3; ++c) {
      auto& poly = interval.c[std::size_t(column(term, int(c)))];
      const double da = a1[c] - a0[c], db = b1[c] - b0[c];
      poly[0] += a0[c] * b0[c];
      poly[1] += a0[c] * db + da * b0[c];
      poly[2] += da * db;
    }
  }
}

void MediumBuilder::add_opaque(const Extinction& extinction, const Curve& color, bool surface) {
  for (const auto& [v0, v1] : extinction.opaque) {
    std::vector<double> edge{v0};
    for (double v : color.breaks())
      if (v > v0 && v < v1) edge.push_back(v);
    edge.push_back(v1);
    for (std::size_t k = 0; k + 1 < edge.size(); ++k) {
      OpaqueRange range{edge[k], edge[k + 1]};
      const bool isosurface = v0 == v1;
      const std::array<Vector3, 2> c{color.at(edge[k]), color.at(edge[k + 1], !isosurface)};
      (surface ? range.S : range.P) = c;
      if (surface) range.W = {Vector3{1, 1, 1}, Vector3{1, 1, 1}};
      medium_.opaque.push_back(range);
    }
  }
}

void MediumBuilder::add_opaque_isosurface(double v, const Vector3& color) {
  const Vector3 one{1, 1, 1};
  medium_.opaque.insert(medium_.opaque.begin(), {v, v, {}, {color, color}, {one, one}});
}

void MediumBuilder::add_dirac(const Dirac& dirac) {
  auto& all = medium_.dirac;
  const auto place =
      std::lower_bound(all.begin(), all.end(), dirac.v, [](const Dirac& d, double v) { return d.v < v; });
  if (place == all.end() || place->v != dirac.v) {
    all.insert(place, dirac);
    return;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double mu = place->mu[c] + dirac.mu[c];
    if (mu > 0) place->c[c] = (place->mu[c] * place->c[c] + dirac.mu[c] * dirac.c[c]) / mu;
    place->mu[c] = mu;
  }
}

Medium MediumBuilder::take() { return std::move(medium_); }

}  // namespace dvrlab
