#include "framework/scene/memory_bill.h"

#include <algorithm>
#include <cstdio>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

std::string mib(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f MiB", bytes / 1048576);
  return text;
}

}  // namespace

double MemoryBill::sum() const {
  double sum = 0;
  for (const auto& [part, bytes] : parts_) sum += bytes;
  return sum;
}

void MemoryBill::state(const std::string& part, double bytes) {
  const auto known = std::find_if(parts_.begin(), parts_.end(), [&](const auto& p) { return p.first == part; });
  if (known != parts_.end()) {
    known->second = bytes;
  } else {
    parts_.emplace_back(part, bytes);
  }
  if (sum() <= limit_) return;
  std::string list;
  for (const auto& [name, size] : parts_) list += (list.empty() ? "" : " + ") + name + " " + mib(size);
  throw NotSupported("the case needs " + mib(sum()) + " of memory (" + list + "); " + limit_text_ + " " + mib(limit_) +
                     " (raise limits.memory, or take smaller data, tables or images)");
}

}  // namespace dvrlab
