// The fingerprint of data in result files.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dvrlab {

/// SHA-256 of the parts, one after the other, as 64 hexadecimal digits.
std::string sha256(const std::vector<std::span<const std::byte>>& parts);

}  // namespace dvrlab
