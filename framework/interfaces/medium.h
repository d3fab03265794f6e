// The medium: the normal form of every optical model (docs/math, section A). The only thing that an estimator
// ever sees of an optical model.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/interfaces/parameter_set.h"
#include "framework/interfaces/plugin.h"

namespace dvrlab {

/// The terms of the normal form, three columns (r, g, b) each. Units: *_l per world length, *_s per unit of value.
enum class Term { tau_l, E, P, S_l, W_l, tau_s, S_s, W_s };
inline constexpr int term_count = 8;
inline constexpr int medium_columns = 3 * term_count;
inline constexpr int column(Term t, int channel) { return 3 * static_cast<int>(t) + channel; }

/// A bit set of terms, for `handles` and for what a medium uses.
struct Terms {
  unsigned bits = 0;
  static constexpr unsigned bit(Term t) { return 1u << static_cast<int>(t); }
  static constexpr unsigned dirac_bit = 1u << term_count;
  static constexpr unsigned rgb_bit = 1u << (term_count + 1);       // extinction differs between channels
  static constexpr unsigned every_column = (1u << term_count) - 1;  // all but Dirac terms, grey

  bool has(Term t) const { return (bits & bit(t)) != 0; }
  bool dirac() const { return (bits & dirac_bit) != 0; }
  bool surfaces() const { return has(Term::tau_s) || has(Term::S_s) || has(Term::W_s); }
  bool rgb() const { return (bits & rgb_bit) != 0; }
  /// "tau_l, S_l, Dirac": for messages.
  std::string text() const;
};

/// All columns on [v0, v1) as polynomials c[0] + c[1] t + c[2] t^2 of t = (v - v0) / (v1 - v0).
struct MediumInterval {
  double v0, v1;
  std::array<std::array<double, 3>, medium_columns> c;
};

/// A discrete isosurface of finite optical depth mu and colour c (docs/math, section A).
struct Dirac {
  double v;
  Vector3 mu, c;
};

/// Values of infinite extinction: a ray ends where its value enters the closed range [v0, v1], with the colour
/// m P + k S + b W, each linear from v0 (index 0) to v1 (index 1). v0 = v1: an isosurface that nothing passes, crossed
/// by the rule of Dirac terms. An end may lie beyond every value. Every estimator integrates up to the entrance; the
/// framework ends the ray there.
struct OpaqueRange {
  double v0, v1;
  std::array<Vector3, 2> P{}, S{}, W{};
};

/// Piecewise quadratic in the value v, constant outside [front().v0, back().v1]. Intervals are contiguous and
/// ascending; a jump is a change between neighbours, and the value at a jump is the right one.
struct Medium {
  std::vector<MediumInterval> interval;
  std::vector<Dirac> dirac;         // ascending
  std::vector<OpaqueRange> opaque;  // where two overlap, the first one holds

  /// All columns at v. `from_left` asks for the limit from the left.
  std::array<double, medium_columns> at(double v, bool from_left = false) const;
  Terms terms() const;
  /// True if every column is 0 and there is no Dirac and no opaque value on the closed interval [a, b].
  bool empty(double a, double b) const;
  /// True if S_l, W_l, S_s, W_s are 0 and there is no Dirac and no shaded opaque value on the closed interval [a, b].
  bool unshaded(double a, double b) const;
  /// True if some value emits without extinction, so that its chromaticity, source by extinction, is infinite.
  bool glows_without_extinction() const;
  /// True if any value is lit by a surface: S, W, a Dirac.
  bool shaded() const;
  /// The same medium with more interval borders.
  Medium split_at(const std::vector<double>& borders) const;
  /// The same medium as a function of w = (v - intercept) / slope. Surface terms are per unit of w then.
  Medium rescaled(double slope, double intercept) const;
};

/// What an optical model is told beside its own parameters.
struct ModelContext {
  /// `opaque`: what fully opaque transfer function entries become (docs/math, section 0).
  enum class Opaque { interval, dirac, cap };
  double length_unit;               // world units per unit of the config's lengths
  bool opacity_interpolation;       // `interpolation`: false = "extinction", true = "opacity"
  bool linear_color;                // image.space "linear": transfer function colours are decoded from sRGB
  double value_min, value_max;      // the data's range, in the unit of the transfer functions (`tf_domain`)
  Opaque opaque;                    // infinite extinction
  double opaque_width;              // width of an isolated opaque entry with Opaque::interval: one table bin
  std::vector<std::string>* notes;  // what was capped or refined, said aloud
};

/// An optical model: transfer functions in, medium out. Host code only.
class OpticalModelPlugin : public Plugin {
 public:
  /// A function of the transfer functions' value; the framework converts it to stored values.
  virtual Medium medium(const ParameterSet& parameters, const ModelContext& context) const = 0;
};

}  // namespace dvrlab
