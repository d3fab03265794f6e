#include "framework/scene/system_memory.h"

#include <fstream>
#include <string>

#include "framework/interfaces/error.h"

namespace dvrlab {

SystemMemory system_memory() {
  std::ifstream in("/proc/meminfo");
  SystemMemory memory;
  std::string name, rest;
  std::uint64_t kib = 0;
  while (in >> name >> kib) {
    std::getline(in, rest);
    if (name == "MemTotal:") memory.total = kib * 1024;
    if (name == "MemAvailable:") memory.available = kib * 1024;
  }
  if (memory.available == 0) throw NotSupported("/proc/meminfo does not say how much memory is available");
  return memory;
}

}  // namespace dvrlab
