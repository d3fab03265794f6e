// A kernel module of another kernel ABI: nothing behind the number may be read.
#include "framework/interfaces/kernel_module.h"

namespace {
struct {
  int abi = DVR_KERNEL_ABI + 1000;
  void* poison[16] = {};
} module;
}  // namespace

extern "C" __attribute__((visibility("default"))) const dvr_kernel_module* dvrlab_kernel_module() {
  return reinterpret_cast<const dvr_kernel_module*>(&module);
}
