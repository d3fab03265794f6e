// Voxels that a file holds as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "framework/scene/voxels.h"

namespace dvrlab {

/// What was found: bytes of voxels written, and whether more text follows that is not blank.
struct TextVoxels {
  std::uint64_t bytes;
  bool more;
};

/// Numbers between blanks, line ends or commas, written in the machine's byte order until `out` is full.
/// Throws InputError, `where` in front, for the first one that is no number of the type.
TextVoxels read_ascii(std::span<const std::byte> text, SourceType type, std::span<std::byte> out,
                      const std::string& where);

/// Two hexadecimal digits per byte, blanks and line ends anywhere between bytes.
/// Throws InputError, `where` in front, for another character.
TextVoxels read_hex(std::span<const std::byte> text, std::span<std::byte> out, const std::string& where);

}  // namespace dvrlab
