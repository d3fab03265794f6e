// Transfer functions as optical models use them: piecewise linear curves with jumps, and the canonical piecewise
// linear medium that their products form (docs/math, section 0).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/interfaces/medium.h"
#include "framework/interfaces/parameter_set.h"

namespace dvrlab {

/// Piecewise linear in the value, constant outside the nodes; two nodes of equal value are a jump whose value is the
/// right one.
class Curve {
 public:
  explicit Curve(const Nodes& nodes) : nodes_(nodes.node) {}
  explicit Curve(const Vector3& constant) : nodes_{{0.0, constant}} {}
  /// All components at v; `from_left` asks for the limit from the left.
  Vector3 at(double v, bool from_left = false) const;
  /// Node values, ascending, each once.
  std::vector<double> breaks() const;
  std::vector<Node>& nodes() { return nodes_; }
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  std::vector<Node> nodes_;
};

/// Opacity nodes -> extinction nodes: mu = -ln(1 - alpha) / std, per component. An opaque node is capped at
/// 16.6 / std (a transmittance of 2^-24 per std) and said aloud in `notes` with `name`.
Curve extinction_of(const Nodes& opacity, double standard_length, const std::string& name,
                    std::vector<std::string>& notes);

/// The same with opacity linear between the nodes (`interpolation: "opacity"`): a refined piecewise linear curve whose
/// deviation from -ln(1 - alpha(v)) / std is at most 1e-5 of the curve's largest value.
Curve extinction_of_interpolated_opacity(const Nodes& opacity, double standard_length, const std::string& name,
                                         std::vector<std::string>& notes);

/// sRGB display value -> linear light (IEC 61966-2-1), for image.space "linear".
double display_to_linear(double x);

/// Builds a medium on the union of the breaks. `fill` receives each curve's ends on an interval and adds columns.
class MediumBuilder {
 public:
  /// All curves that any column will use; their breaks become the interval borders.
  explicit MediumBuilder(const std::vector<const Curve*>& curves);
  /// term += factor * a(v), per channel.
  void add(Term term, const Curve& a, double factor = 1.0);
  /// term += a(v) * b(v), per channel: piecewise quadratic.
  void add_product(Term term, const Curve& a, const Curve& b);
  Medium take() { return std::move(medium_); }

 private:
  Medium medium_;
};

}  // namespace dvrlab
