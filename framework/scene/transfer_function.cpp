#include "framework/interfaces/transfer_function.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dvrlab {

namespace {
constexpr double opaque_depth = 16.6;  // math section 0: -ln 2^-24, the cap of an opaque node per standard length

double capped_extinction(double alpha, double standard_length, bool& capped) {
  const double depth = -std::log1p(-std::min(alpha, 1.0));
  if (depth > opaque_depth) capped = true;
  return std::min(depth, opaque_depth) / standard_length;
}

void note_cap(const std::string& name, double standard_length, std::vector<std::string>& notes) {
  char text[160];
  std::snprintf(text, sizeof(text), "opaque entries capped at extinction %.6g per world unit (16.6 / standard length)",
                opaque_depth / standard_length);
  notes.push_back(name + ": " + text);
}

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

Curve extinction_of(const Nodes& opacity, double standard_length, const std::string& name,
                    std::vector<std::string>& notes) {
  Curve curve(opacity);
  bool capped = false;
  for (Node& n : curve.nodes())
    for (double& x : n.x) x = capped_extinction(x, standard_length, capped);
  if (capped) note_cap(name, standard_length, notes);
  return curve;
}

namespace {
// Appends the nodes behind a, up to and including b, so that the chords follow mu(alpha(v)) to `tolerance`.
void refine(const Node& a, const Node& b, double standard_length, double tolerance, int depth, bool& capped,
            std::vector<Node>& out) {
  const double v = 0.5 * (a.value + b.value);
  const Vector3 alpha = lerp(a.x, b.x, 0.5);
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double chord =
        0.5 * (capped_extinction(a.x[c], standard_length, capped) + capped_extinction(b.x[c], standard_length, capped));
    worst = std::max(worst, std::abs(capped_extinction(alpha[c], standard_length, capped) - chord));
  }
  if (depth == 0 || worst <= tolerance || v <= a.value || v >= b.value) {
    out.push_back(b);
    return;
  }
  refine(a, {v, alpha}, standard_length, tolerance, depth - 1, capped, out);
  refine({v, alpha}, b, standard_length, tolerance, depth - 1, capped, out);
}
}  // namespace

Curve extinction_of_interpolated_opacity(const Nodes& opacity, double standard_length, const std::string& name,
                                         std::vector<std::string>& notes) {
  bool capped = false;
  double largest = 0;
  for (const Node& n : opacity.node)
    for (double x : n.x) largest = std::max(largest, capped_extinction(x, standard_length, capped));
  Nodes refined;
  refined.components = opacity.components;
  refined.node.push_back(opacity.node.front());
  for (std::size_t k = 1; k < opacity.node.size(); ++k) {
    if (opacity.node[k].value > opacity.node[k - 1].value)
      refine(opacity.node[k - 1], opacity.node[k], standard_length, 1e-5 * largest, 24, capped, refined.node);
    else
      refined.node.push_back(opacity.node[k]);
  }
  Curve curve = extinction_of(refined, standard_length, name, notes);
  notes.push_back(name + ": opacity interpolation as " + std::to_string(curve.nodes().size()) +
                  " extinction nodes, 1e-5 of the largest extinction");
  return curve;
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

}  // namespace dvrlab
