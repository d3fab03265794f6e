// A plugin of another ABI: nothing behind the tag may be read, so nothing valid stands there.
#include "framework/interfaces/plugin.h"

namespace {
struct {
  const char* abi_tag = "dvrlab-0-of-long-ago";
  void* poison[9] = {};
} descriptor;
}  // namespace

extern "C" __attribute__((visibility("default"))) const dvrlab::PluginDescriptor* dvrlab_plugin() {
  return reinterpret_cast<const dvrlab::PluginDescriptor*>(&descriptor);
}
