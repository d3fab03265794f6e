#include "framework/report/byte_text.h"

#include <cstdio>

namespace dvrlab {

std::string byte_text(std::uint64_t bytes) {
  const char* const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  double x = static_cast<double>(bytes);
  int unit = 0;
  while (x >= 1024) {
    x /= 1024;
    ++unit;
  }
  char text[32];
  std::snprintf(text, sizeof text, x >= 999.5 ? "%.0f %s" : "%.3g %s", x, units[unit]);
  return text;
}

}  // namespace dvrlab
