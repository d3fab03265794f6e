// Whether a raw file has the size that its declaration asks for, and what would fit if not.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "framework/scene/voxels.h"

namespace dvrlab::raw {

struct Declared {
  std::array<long long, 3> dims;
  SourceType type;
  std::optional<std::uint64_t> skip;  // bytes; without it the file holds the voxels and nothing else
};

/// "" when `file_bytes` fit; otherwise one sentence with the bytes needed, the bytes there, and the declarations that
/// would fit.
std::string wrong_size(const Declared& declared, std::uint64_t file_bytes);

}  // namespace dvrlab::raw
