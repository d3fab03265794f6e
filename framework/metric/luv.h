// CIE 1976 L*u*v* of display colours (CIE 15; sRGB: IEC 61966-2-1).
#pragma once

#include <array>

namespace dvrlab {

/// L*, u*, v* of sRGB: display values in [0, 1] are decoded (`linear`: they are not), brought to XYZ by the matrix of
/// the standard's primaries and D65, and related to the white of (1, 1, 1). Values outside [0, 1] are clamped, as a
/// display does. Black has u* = v* = 0.
std::array<double, 3> luv_of(const std::array<double, 3>& rgb, bool linear);

/// Euclidean distance of two colours in L*u*v*; 1 is a just noticeable difference.
double luv_distance(const std::array<double, 3>& a, const std::array<double, 3>& b, bool linear);

}  // namespace dvrlab
