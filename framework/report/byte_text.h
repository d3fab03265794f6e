// Numbers of bytes for people.
#pragma once

#include <cstdint>
#include <string>

namespace dvrlab {

/// "128 MiB", "1.5 GiB", "999 bytes": three digits, in the largest binary unit of which there is at least one.
std::string byte_text(std::uint64_t bytes);

}  // namespace dvrlab
