#include "framework/plugin/open_library.h"

#include <dlfcn.h>

#include <cstring>

namespace dvrlab {
namespace {

OpenedLibrary refused(std::string problem) { return {nullptr, std::move(problem)}; }

const PluginDescriptor* call_entry(PluginEntry entry, std::string& problem) {
  try {
    return entry();
  } catch (...) {  // the entry point is another compiler's code: whatever it throws must not get further
    problem = " threw an exception";
  }
  return nullptr;
}

}  // namespace

OpenedLibrary open_library(const std::string& library, const std::string& kind, const std::string& name) {
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    return refused("is not loadable: " + std::string(dlerror()) + " (build it again, or install what it needs)");
  }
  void* symbol = dlsym(handle, plugin_entry_name);
  if (symbol == nullptr) {
    return refused("has no entry point: " + library + " does not export '" + plugin_entry_name +
                   "' (declare the plugin with DVRLAB_PLUGIN)");
  }
  std::string problem = " returned no descriptor";
  const PluginDescriptor* d = call_entry(reinterpret_cast<PluginEntry>(symbol), problem);
  if (d == nullptr)
    return refused("has a broken entry point: '" + std::string(plugin_entry_name) + "' of " + library + problem);
  // The tag comes first: only when it fits may anything else of the descriptor be read.
  const char* tag = d->abi_tag != nullptr ? d->abi_tag : "(none)";
  if (std::strcmp(tag, DVRLAB_ABI_TAG) != 0) {
    return refused("has another ABI: " + library + " was built for " + tag + ", this dvrlab is " + DVRLAB_ABI_TAG +
                   " (build the plugin against this version)");
  }
  if (kind != d->kind || name != d->name) {
    return refused("is misplaced: " + library + " declares " + d->kind + " '" + d->name + "', its folders say " + kind +
                   " '" + name + "' (folder and declaration must agree)");
  }
  return {d, ""};
}

}  // namespace dvrlab
