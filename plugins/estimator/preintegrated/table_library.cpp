#include "plugins/estimator/preintegrated/table_library.h"

#include <dlfcn.h>

#include <map>
#include <mutex>
#include <stdexcept>

#include "backends/cpu/isa.h"

namespace dvrlab::preintegrated {

namespace {
const dvr_table_module* open(const std::string& file) {
  const auto broken = [&](const std::string& why) {
    return std::runtime_error("estimator preintegrated: " + file + " " + why + " (build the plugin again)");
  };
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw broken("is not loadable: " + std::string(dlerror()));
  using Entry = const dvr_table_module* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(library, DVR_TABLE_ENTRY));
  if (entry == nullptr) throw broken("exports no " DVR_TABLE_ENTRY);
  const dvr_table_module* module = entry();
  if (module->abi != DVR_TABLE_ABI)
    throw broken("has table ABI " + std::to_string(module->abi) + ", this dvrlab has " + std::to_string(DVR_TABLE_ABI));
  return module;
}
}  // namespace

const dvr_table_module& table_module(const std::string& folder, const std::string& isa) {
  static std::mutex guard;
  static std::map<std::string, const dvr_table_module*> opened;
  const std::string file = folder + "/table." + cpu::choose_isa(isa) + ".so";
  const std::lock_guard lock(guard);
  auto known = opened.find(file);
  if (known == opened.end()) known = opened.emplace(file, open(file)).first;
  return *known->second;
}

}  // namespace dvrlab::preintegrated
