// Opacity -> extinction (docs/math, section 0): two ways to interpolate, three ways to be opaque.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "framework/interfaces/error.h"
#include "framework/interfaces/transfer_function.h"

namespace dvrlab {
namespace {

constexpr double opaque_depth = 16.6;  // math section 0: -ln 2^-24, the cap of an opaque node per standard length

class Converter {
 public:
  Converter(const Curve& opacity, const Curve* transmission, double standard)
      : opacity_(opacity), transmission_(transmission), standard_(standard) {}

  /// The opacity at v, per channel; `from_left` asks for the limit from the left.
  Vector3 alpha(double v, bool from_left) const {
    Vector3 a = opacity_.at(v, from_left);
    if (transmission_ == nullptr) return a;
    const Vector3 t = transmission_->at(v, from_left);
    for (std::size_t c = 0; c < 3; ++c) a[c] *= 1.0 - t[c];
    return a;
  }

  Vector3 extinction(const Vector3& alpha) {
    Vector3 mu;
    for (std::size_t c = 0; c < 3; ++c) {
      const double depth = -std::log1p(-std::min(alpha[c], 1.0));
      capped_ = capped_ || depth > opaque_depth;
      mu[c] = std::min(depth, opaque_depth) / standard_;
    }
    return mu;
  }

  /// The opacity at every break of both curves, twice where it jumps.
  std::vector<Node> at_breaks() const {
    std::set<double> breaks;
    for (double v : opacity_.breaks()) breaks.insert(v);
    if (transmission_ != nullptr)
      for (double v : transmission_->breaks()) breaks.insert(v);
    std::vector<Node> nodes;
    for (double v : breaks) {
      const Vector3 left = alpha(v, true), right = alpha(v, false);
      if (left != right) nodes.push_back({v, left});
      nodes.push_back({v, right});
    }
    return nodes;
  }

  /// Appends extinction nodes behind a, up to b, so that their chords follow the extinction of the opacity.
  void refine(double a, double b, double tolerance, int depth, std::vector<Node>& out) {
    const double v = 0.5 * (a + b);
    const Vector3 mu_a = out.back().x, mu = extinction(alpha(v, false)), mu_b = extinction(alpha(b, true));
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(mu[c] - 0.5 * (mu_a[c] + mu_b[c])));
    if (depth > 0 && worst > tolerance && v > a && v < b) {
      refine(a, v, tolerance, depth - 1, out);
      refine(v, b, tolerance, depth - 1, out);
    } else {
      out.push_back({b, mu_b});
    }
  }

  bool capped() const { return capped_; }

 private:
  const Curve& opacity_;
  const Curve* transmission_;
  double standard_;
  bool capped_ = false;
};

bool opaque(const Node& n) {
  return std::all_of(n.x.begin(), n.x.end(), [](double a) { return a >= 1.0; });
}

/// Neighbouring opaque entries bound a range; an isolated one is `width` wide. The curve is constant outside its nodes.
std::vector<std::pair<double, double>> opaque_ranges(const std::vector<Node>& alpha, double width) {
  constexpr double beyond = std::numeric_limits<float>::max();
  std::vector<std::pair<double, double>> ranges;
  for (std::size_t first = 0; first < alpha.size(); ++first) {
    if (!opaque(alpha[first])) continue;
    std::size_t last = first;
    while (last + 1 < alpha.size() && opaque(alpha[last + 1])) ++last;
    double v0 = alpha[first].value, v1 = alpha[last].value;
    if (first == last) {
      v0 -= 0.5 * width;
      v1 += 0.5 * width;
    }
    if (first == 0) v0 = -beyond;
    if (last + 1 == alpha.size()) v1 = beyond;
    ranges.emplace_back(v0, v1);
    first = last;
  }
  return ranges;
}

void check_opacity(const Curve& curve, const std::string& name) {
  for (const Node& n : curve.nodes()) {
    for (double a : n.x) {
      if (a >= 0 && a <= 1) continue;
      char text[120];
      std::snprintf(text, sizeof text, ": found %g at value %g; must be in [0, 1]", a, n.value);
      throw InputError(name + text);
    }
  }
}

std::string note_text(const char* format, double a, double b) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

}  // namespace

Extinction extinction_of(const Curve& opacity, const Curve* transmission, double standard, const std::string& name,
                         const ModelContext& context) {
  check_opacity(opacity, name);
  if (transmission != nullptr) check_opacity(*transmission, name + ", its transmission");
  Converter convert(opacity, transmission, standard);
  const std::vector<Node> alpha = convert.at_breaks();
  std::vector<Node> mu;
  double largest = 0;
  for (const Node& n : alpha) {
    mu.push_back({n.value, convert.extinction(n.x)});
    for (double x : mu.back().x) largest = std::max(largest, x);
  }
  if (context.opacity_interpolation) {
    std::vector<Node> refined{mu.front()};
    for (std::size_t k = 1; k < mu.size(); ++k) {
      if (mu[k].value > mu[k - 1].value)
        convert.refine(mu[k - 1].value, mu[k].value, 1e-5 * largest, 24, refined);
      else
        refined.push_back(mu[k]);
    }
    mu = std::move(refined);
    context.notes->push_back(name + ": opacity interpolation as " + std::to_string(mu.size()) +
                             " extinction nodes, 1e-5 of the largest extinction");
  }
  Extinction result{Curve(std::move(mu)), {}};
  if (context.opaque != ModelContext::Opaque::cap)
    result.opaque = opaque_ranges(alpha, context.opaque == ModelContext::Opaque::dirac ? 0.0 : context.opaque_width);
  for (const auto& [v0, v1] : result.opaque)
    context.notes->push_back(name + (v0 == v1 ? note_text(": opaque isosurface at %g", v0, v1)
                                              : note_text(": opaque from %g to %g", v0, v1)));
  if (convert.capped())
    context.notes->push_back(name +
                             note_text(": entries that are nearly or fully opaque have the extinction %.6g (16.6 / "
                                       "%g) where they are interpolated",
                                       opaque_depth / standard, standard));
  return result;
}

}  // namespace dvrlab
