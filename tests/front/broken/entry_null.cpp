// Its entry point returns nothing.
#include "framework/interfaces/plugin.h"

extern "C" __attribute__((visibility("default"))) const dvrlab::PluginDescriptor* dvrlab_plugin() { return nullptr; }
