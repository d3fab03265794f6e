// Keys that estimators share, so that they mean the same everywhere.
#pragma once

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
