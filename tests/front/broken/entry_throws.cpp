// Its entry point throws.
#include <stdexcept>

#include "framework/interfaces/plugin.h"

extern "C" __attribute__((visibility("default"))) const dvrlab::PluginDescriptor* dvrlab_plugin() {
  throw std::runtime_error("no descriptor today");
}
