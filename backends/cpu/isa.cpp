#include "backends/cpu/isa.h"

#include <sched.h>

#include <fstream>

#include "framework/interfaces/error.h"

namespace dvrlab::cpu {

namespace {
bool usable(const std::string& isa) {
  if (isa == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
  if (isa == "avx2") return __builtin_cpu_supports("avx2");
  if (isa == "sse4.2") return __builtin_cpu_supports("sse4.2");
  return true;
}
}  // namespace

std::vector<std::string> usable_isas() {
  std::vector<std::string> isas;
  for (const char* isa : {"scalar", "sse4.2", "avx2", "avx512"})
    if (usable(isa)) isas.emplace_back(isa);
  return isas;
}

std::string choose_isa(const std::string& wanted) {
  if (wanted == "auto") return usable_isas().back();
  if (!usable(wanted))
    throw NotSupported("backend cpu: this processor (" + processor_name() + ") has no " + wanted +
                       "; use isa \"auto\"");
  return wanted;
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

int thread_count(int wanted) {
  if (wanted > 0) return wanted;
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof(set), &set) == 0) return CPU_COUNT(&set);
  return 1;
}

}  // namespace dvrlab::cpu
