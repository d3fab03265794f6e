// What `dvrlab doctor` finds out. Nothing here throws for something that is missing: that is a finding.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framework/interfaces/backend.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

struct BackendFinding {
  std::string name;
  bool runs = false;
  BackendReport report;
};

/// Kernel modules of one instruction set, over all plugins that have kernels.
struct ModuleFinding {
  std::string isa;
  int present = 0, expected = 0;
};

struct FolderFinding {
  std::string path;
  std::map<std::string, int> usable;  // kind -> number of plugins
};

struct PluginProblem {
  std::string plugin, reason;  // "data/nifti"
};

struct CacheFinding {
  std::string folder;
  bool exists = false;
  std::string problem;  // "" when it can be written
  std::uint64_t files = 0, bytes = 0;
};

struct Doctor {
  std::vector<BackendFinding> backends;
  std::vector<ModuleFinding> modules;
  std::vector<FolderFinding> folders;
  std::vector<std::string> missing_folders;  // "DVRLAB_PLUGIN_PATH: there is no folder '/nope'"
  std::vector<PluginProblem> broken, not_built;
  CacheFinding cache;
  std::uint64_t memory_total = 0, memory_available = 0;  // bytes; 0: the system does not tell
  bool can_render() const;
};

Doctor examine(const Registry& registry);

/// Parts of examine().
std::vector<BackendFinding> examine_backends(const Registry& registry);
std::vector<ModuleFinding> examine_modules(const Registry& registry);
CacheFinding examine_cache();

}  // namespace dvrlab
