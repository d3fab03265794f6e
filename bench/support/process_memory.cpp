#include "bench/support/process_memory.h"

#include <fstream>
#include <string>

namespace dvrlab::bench {
namespace {

double kibibytes(const std::string& wanted) {
  std::ifstream status("/proc/self/status");
  std::string key;
  double value = 0;
  while (status >> key) {
    if (key == wanted && status >> value) return value;
    status.ignore(4096, '\n');
  }
  return 0;
}

}  // namespace

double resident_bytes() { return 1024 * kibibytes("VmRSS:"); }
double peak_bytes() { return 1024 * kibibytes("VmHWM:"); }

}  // namespace dvrlab::bench
