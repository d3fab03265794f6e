#include "tests/kernel/probes.h"

#include <dlfcn.h>

#include <cstdio>
#include <stdexcept>

namespace dvrlab::kernel_test {
namespace {

bool usable(const std::string& isa) {
  if (isa == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
  if (isa == "avx2") return __builtin_cpu_supports("avx2");
  if (isa == "sse4.2") return __builtin_cpu_supports("sse4.2");
  return true;
}

std::vector<Isa> open_all() {
  std::vector<Isa> opened;
  for (const char* name : {"scalar", "sse4.2", "avx2", "avx512"}) {
    if (!usable(name)) {
      std::printf("not supported: this processor has no %s\n", name);
      continue;
    }
    const std::string file = std::string(DVRLAB_PROBE_FOLDER "/probe.") + name + ".so";
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    using Entry = const kernel_probe* (*)();
    opened.push_back({name, reinterpret_cast<Entry>(dlsym(library, "dvrlab_kernel_probe"))()});
  }
  return opened;
}

}  // namespace

const std::vector<Isa>& isas() {
  static const std::vector<Isa> all = open_all();
  return all;
}

}  // namespace dvrlab::kernel_test
