// The machine's memory.
#pragma once

#include <cstdint>

namespace dvrlab {

struct SystemMemory {
  std::uint64_t total = 0, available = 0;  // bytes; available: without swapping
};

/// Throws NotSupported where the system does not tell.
SystemMemory system_memory();

}  // namespace dvrlab
