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
  explicit Curve(std::vector<Node> nodes) : nodes_(std::move(nodes)) {}
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

/// An extinction curve and the closed ranges of values where the extinction is infinite in every channel.
struct Extinction {
  Curve curve;                                    // finite everywhere: capped at 16.6 / standard
  std::vector<std::pair<double, double>> opaque;  // ascending; equal ends: an opaque isosurface
};

/// Opacity curve -> extinction mu = -ln(1 - alpha) / standard per component, alpha = opacity (1 - transmission)
/// (Yang et al. 2012, equations 24 to 26; `transmission` null: 0). `standard` is the length or difference of values
/// that the opacity refers to. `context.opacity_interpolation`: false converts at the nodes of both curves and
/// interpolates the extinction; true interpolates the opacity, as a refined list of nodes (1e-5 of the largest
/// extinction). Fully opaque entries become what `context.opaque` says; what was capped or refined is said aloud with
/// `name`, the key's path. Throws InputError for an opacity or transmission outside [0, 1].
Extinction extinction_of(const Curve& opacity, const Curve* transmission, double standard, const std::string& name,
                         const ModelContext& context);

/// For Plugin::check: a colour without the amount that it colours does nothing. Throws InputError at its path.
void require_amount(const ParameterSet& p, const char* color, const char* amount);

/// A colour transfer function: decoded from sRGB where `context.linear_color` asks for it.
Curve color_curve(const Nodes& nodes, const ModelContext& context);

/// sRGB display value -> linear light (IEC 61966-2-1), for image.space "linear".
double display_to_linear(double x);

/// Builds a medium on the union of the curves' breaks.
class MediumBuilder {
 public:
  /// All curves that any column will use; their breaks become the interval borders.
  explicit MediumBuilder(const std::vector<const Curve*>& curves);
  /// Adds to a medium whose interval borders hold the breaks of all curves that will be added.
  explicit MediumBuilder(Medium medium) : medium_(std::move(medium)) {}
  /// term += factor * a(v), per channel.
  void add(Term term, const Curve& a, double factor = 1.0);
  /// term += a(v) * b(v), per channel: piecewise quadratic.
  void add_product(Term term, const Curve& a, const Curve& b);
  /// Opaque ranges of particles (P, lit without a normal) or of surfaces (S, with a highlight), coloured by `color`.
  void add_opaque(const Extinction& extinction, const Curve& color, bool surface);
  /// A Dirac term; where one lies already, they merge: mu adds up, the colours are weighted by mu.
  void add_dirac(const Dirac& dirac);
  /// An isosurface of opacity 1.
  void add_opaque_isosurface(double v, const Vector3& color);
  Medium take();

 private:
  Medium medium_;
};

}  // namespace dvrlab
