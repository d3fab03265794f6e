// The exact integral of one segment through a medium in normal form, in fp64: the truth for estimators and their
// tables.
#pragma once

#include "framework/interfaces/medium.h"

namespace dvrlab::test {

/// Per channel; back: the part weighted with the position in the segment (0 at its front, 1 at its back).
struct SegmentIntegral {
  Vector3 T{1, 1, 1};
  Vector3 E{}, P{}, S{}, W{};  // with light factor 1; S and W include the Dirac terms
  Vector3 P_back{}, S_back{}, W_back{};
};

/// From v0 (eye side) to v1 over the length h: split at the medium's nodes and Diracs, Gauss-Legendre panels of 12
/// points bounded by optical depth (docs/math, section B.8). A Dirac is crossed when min(v0, v1) < v_i <= max(v0, v1).
SegmentIntegral integrate_segment(const Medium& medium, double v0, double v1, double h);

}  // namespace dvrlab::test
