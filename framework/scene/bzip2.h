// Decompression of bzip2 streams into a known number of bytes.
#pragma once

#include <memory>

#include "framework/scene/unpacker.h"

namespace dvrlab {

std::unique_ptr<Unpacker> bzip2_unpacker(std::span<const std::byte> in, const std::string& where);

/// Streams of `compressed` bytes never hold more than this many. A block takes 24 bytes at the least and expands to at
/// most 900000 bytes, which the run-length code in front of it stretches by 259/5.
std::uint64_t bunzip2_limit(std::uint64_t compressed);

}  // namespace dvrlab
