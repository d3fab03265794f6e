#include "framework/scene/tf_domain.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

using Range = std::pair<double, double>;

/// Physical values of two stored ones, the smaller first: a slope may be negative.
Range physical(const Field& f, double a, double b) {
  return std::minmax({f.slope * a + f.intercept, f.slope * b + f.intercept});
}

Range type_range(const Field& field, const std::string& key) {
  const auto* grid = dynamic_cast<const GridField*>(&field);
  if (grid == nullptr)
    throw InputError(key + ": \"type\" needs voxels, this field is a formula; use \"data\" or [lo, hi]");
  switch (grid->type) {
    case VoxelType::u8:
      return physical(field, 0, 255);
    case VoxelType::i8:
      return physical(field, -128, 127);
    case VoxelType::u16:
      return physical(field, 0, 65535);
    case VoxelType::i16:
      return physical(field, -32768, 32767);
    case VoxelType::f32:
      break;
  }
  throw InputError(key +
                   ": \"type\" needs voxels of an integer type, these are kept as float32; use \"data\" or "
                   "[lo, hi]");
}

Range range_of(const ParameterSet& p, const Field& field) {
  const nlohmann::json& range = p.json("tf_domain_range");
  if (range.is_array()) return {range[0].get<double>(), range[1].get<double>()};
  if (range == "type") return type_range(field, p.path_of("tf_domain_range"));
  const Range found = physical(field, field.stored_min, field.stored_max);
  if (found.first < found.second) return found;
  throw InputError(p.path_of("tf_domain_range") + ": all values of the data are " + nlohmann::json(found.first).dump() +
                   ", which is no range that transfer functions could be spread over; give [lo, hi]");
}

}  // namespace

TfDomain tf_domain(const ParameterSet& p, const Field& field) {
  TfDomain d;
  const std::string how = p.text("tf_domain");
  if (how == "physical") return d;
  std::tie(d.lo, d.hi) = range_of(p, field);
  if (how == "quantized") d.top = double((1 << p.integer("tf_bits")) - 1);
  char text[160];
  std::snprintf(text, sizeof(text), "optical_model.tf_domain: %s: 0 to %g are the physical values %.9g to %.9g",
                how.c_str(), d.top, d.lo, d.hi);
  d.note = text;
  return d;
}

}  // namespace dvrlab
