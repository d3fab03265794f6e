// Which array of each piece is the volume, and how the pieces lie together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/scene/voxels.h"
#include "plugins/data/vti/vti_header.h"

namespace dvrlab::vti {

/// What the config asks for.
struct Wanted {
  std::string array;                     // "" for the active one, or the only one
  long long component = -1;              // -1: the array has only one
  std::string array_key, component_key;  // their places in the config, for errors
};

/// One piece's values.
struct Part {
  DataArray array;
  Extent extent;
  std::uint64_t numbers = 0;  // points times components
  std::string where;          // file, array and line, for errors
};

/// The chosen array of every piece, all of one type. The pieces' cells fill the whole extent, none twice.
struct Parts {
  std::vector<Part> part;
  SourceType type = SourceType::u8;
  std::size_t component = 0;
  /// One piece, one component: its values are the volume's as they stand.
  bool direct() const { return part.size() == 1 && part[0].array.components == 1; }
};

/// Throws InputError when the array cannot be chosen (and lists the names) or when the pieces do not fit.
Parts choose_parts(const VtiHeader& header, const Wanted& wanted, const std::string& name);

/// Copies the chosen component of a part's `values` to its place in the volume of extent `whole`, in this machine's
/// byte order.
void place_part(const Part& part, const SourceVoxels& values, std::size_t component, const Extent& whole,
                std::byte* volume);

}  // namespace dvrlab::vti
