// Keys that estimators share, so that they mean the same everywhere.
#pragma once

#include <string>

#include "framework/interfaces/estimator.h"
#include "framework/interfaces/parameter.h"

namespace dvrlab {

/// Shading inside a segment: the words are the modes of light_of_segment (framework/kernel/light.kernel).
inline constexpr Parameter shading_key{
    "shading",
    ParameterType::choice,
    "",
    "\"linear\"",
    "constant|linear",
    "Light factors inside a segment: those of its middle, or those of both ends and linear between (interpolated "
    "pre-integrated lighting).",
    Affects::pixels,
    "",
    "\"constant\""};

/// With tables that know where the surfaces of a segment lie.
inline constexpr Parameter shading_with_barycentre_key{
    "shading",
    ParameterType::choice,
    "",
    "\"linear\"",
    "constant|linear|barycentre",
    "Light factors inside a segment: those of its middle; those of both ends and linear between (interpolated "
    "pre-integrated lighting); those at the barycentre of its surfaces (Yang et al. 2012, equation 18).",
    Affects::pixels,
    "",
    "\"barycentre\""};

/// With a cubic of the position too.
inline constexpr Parameter shading_with_cubic_key{
    "shading",
    ParameterType::choice,
    "",
    "\"linear\"",
    "constant|linear|nonlinear",
    "Light factors inside a segment: those of its middle; those of both ends and linear between (interpolated "
    "pre-integrated lighting); the cubic through those of the linearly interpolated, normalised gradient at 0, 1/3, "
    "2/3 and 1 of the segment (non-linear gradient interpolation, Guetat et al. 2010).",
    Affects::pixels,
    "",
    "\"nonlinear\""};

/// All of them.
inline constexpr Parameter shading_of_every_kind_key{
    "shading",
    ParameterType::choice,
    "",
    "\"linear\"",
    "constant|linear|barycentre|nonlinear",
    "Light factors inside a segment: those of its middle; those of both ends and linear between (interpolated "
    "pre-integrated lighting); those at the barycentre of its surfaces (Yang et al. 2012, equation 18); the cubic "
    "through those of the linearly interpolated, normalised gradient at 0, 1/3, 2/3 and 1 of the segment (non-linear "
    "gradient interpolation, Guetat et al. 2010).",
    Affects::pixels,
    "",
    "\"nonlinear\""};

/// The mode of light_of_segment that the key `shading` asks for.
inline int segment_shading(const ParameterSet& p) {
  const std::string word = p.text("shading");
  return word == "constant" ? 0 : word == "linear" ? 1 : word == "barycentre" ? 2 : 3;
}

/// The keys of opaque prediction (framework/interfaces/estimator.h), for estimators with one-dimensional tables.
inline constexpr Parameter opaque_prediction_key{
    "opaque_prediction",
    ParameterType::choice,
    "",
    "\"both\"",
    "both|published|off",
    "How a segment finds the first opaque value on its way. both: the next one in its direction; published: the next "
    "one above only, as Lee and Shin 2013 print it, which loses segments of falling values; off: none, "
    "max_extinction stands for infinite extinction.",
    Affects::pixels,
    R"({"optical_model":{"type":"absorption_emission","surface":null,"scattering":null,"dv_std":null,"opacity":[[0.3,0],[0.6,0.1],[0.6,1],[0.7,1],[0.7,0]]}})",
    "\"off\""};
inline constexpr Parameter max_extinction_key{
    "max_extinction",
    ParameterType::number,
    "1/length",
    "16.6",
    "(0,inf)",
    "With opaque_prediction off: the extinction of opaque values, per length unit of the optical model.",
    Affects::pixels,
    R"({"optical_model":{"type":"absorption_emission","surface":null,"scattering":null,"dv_std":null,"opacity":[[0.3,0],[0.6,0.1],[0.6,1],[0.7,1],[0.7,0]]},"estimator":{"opaque_prediction":"off"}})",
    "2",
    "opaque_prediction=off"};

/// Fills an estimator's declaration from them.
inline void declare_prediction(const ParameterSet& p, EstimatorDeclaration& d) {
  d.prediction = static_cast<OpaquePrediction>(p.choice_index("opaque_prediction"));
  d.max_extinction = p.number("max_extinction");
}

/// Bins of the framework's cumulative tables, for estimators that know the medium by them alone.
inline constexpr Parameter mean_table_size_key{"table_size",
                                               ParameterType::integer,
                                               "",
                                               "4096",
                                               "[2,65536]",
                                               "Bins of the cumulative tables.",
                                               Affects::pixels,
                                               "",
                                               "16"};

/// What estimators declare that ask for the mean of a segment's medium once and for nothing else.
inline EstimatorDeclaration declaration_of_means(const ParameterSet& p) {
  EstimatorDeclaration d;
  d.samples = EstimatorDeclaration::Samples::ends;
  d.shading = segment_shading(p);
  d.mean_bins = d.cells = static_cast<int>(p.integer("table_size"));
  d.means = 1;
  declare_prediction(p, d);
  return d;
}
/// Only lengths: no surface terms, no Dirac terms.
inline constexpr unsigned terms_per_length = Terms::bit(Term::tau_l) | Terms::bit(Term::E) | Terms::bit(Term::P) |
                                             Terms::bit(Term::S_l) | Terms::bit(Term::W_l) | Terms::rgb_bit;

inline constexpr Parameter approximate_dirac_key{
    "approximate_dirac",
    ParameterType::number,
    "value",
    "0",
    "[0,inf)",
    "Width of the pulses that stand for Dirac terms, which samples of the medium cannot see; 0 refuses them.",
    Affects::pixels,
    R"({"optical_model":{"type":"hybrid","opacity":null,"surface":{"delta":[{"value":0.5,"opacity":0.6}]}},"estimator":{"approximate_dirac":0.2}})",
    "0.1"};

}  // namespace dvrlab
