// What a case's tables cost and how right they are: every pair of values (v0, v1) as one segment, against the exact
// integral in fp64.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/config/experiment.h"
#include "framework/interfaces/backend.h"
#include "framework/interfaces/field.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

/// Errors of the pairs whose exact segment has a depth in [from, to): the deepest channel's.
struct DepthClass {
  double from = 0, to = 0;
  std::size_t pairs = 0;
  double worst = 0, rms = 0;
};

struct TableStudy {
  std::uint64_t bytes = 0;    // of the mean tables and the estimator's own
  double build_seconds = 0;   // median of the builds: bins, mean tables, the estimator's own
  double length = 0;          // of the segments, world units: the nominal step
  std::vector<double> value;  // of v0 and of v1, in the transfer functions' unit, ascending
  std::vector<double> error;  // [v1][v0]: largest absolute error of radiance and transmittance over the channels
  std::vector<double> depth;  // [v1][v0]
  double worst = 0, rms = 0;
  std::vector<DepthClass> classes;
};

/// `points` values of v0 and of v1, evenly over the range of the case's tables, both ends included; light factors
/// are 1. The tables are built `builds` times. Throws InputError and NotSupported as a render does.
TableStudy study_table(const ResolvedCase& c, const Registry& registry, const Field& field, int points, int builds);

/// The error as a picture: v0 to the right, v1 upwards; dark is 1e-8 and less, each change of hue two decades, white 1.
FrameImage error_picture(const TableStudy& study);

}  // namespace dvrlab
