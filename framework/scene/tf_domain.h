// The values that transfer functions are written in: physical, normalized to 0..1, or quantized to whole numbers.
#pragma once

#include <string>

#include "framework/interfaces/field.h"
#include "framework/interfaces/parameter_set.h"

namespace dvrlab {

/// physical value = lo + (hi - lo) * u / top, u in the transfer functions' unit.
struct TfDomain {
  double lo = 0, hi = 1, top = 1;
  double of_physical(double v) const { return (v - lo) * (top / (hi - lo)); }
  /// The transfer functions' value of stored value w is slope * w + intercept: what Medium::rescaled takes.
  double slope(const Field& field) const { return field.slope * (top / (hi - lo)); }
  double intercept(const Field& field) const { return of_physical(field.intercept); }
  std::string note;  // what is said aloud; "" for physical values
};

/// `tf_domain`, `tf_bits` and `tf_domain_range` of an optical model. Physical: u is the physical value itself.
/// Normalized: u = 0 .. 1, quantized: u = 0 .. 2^tf_bits - 1, from the smallest to the largest value of the range: of
/// the data's values, of its integer voxel type, or as written.
/// Throws InputError naming the key for the range "type" of data that has no integer voxels, and for a range that is
/// one value only.
TfDomain tf_domain(const ParameterSet& model, const Field& field);

}  // namespace dvrlab
