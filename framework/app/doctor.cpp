#include "framework/app/doctor.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "framework/backend/cache_folder.h"
#include "framework/interfaces/error.h"
#include "framework/scene/system_memory.h"

namespace dvrlab {
namespace fs = std::filesystem;
namespace {

std::vector<FolderFinding> examine_folders(const Registry& registry) {
  std::vector<FolderFinding> folders;
  for (const std::string& root : registry.roots()) {
    FolderFinding f{root, {}};
    for (const PluginEntryInfo& e : registry.entries())
      if (e.descriptor != nullptr && e.folder.starts_with(root + "/")) ++f.usable[e.kind];
    folders.push_back(std::move(f));
  }
  return folders;
}

/// The build writes a line per plugin: "data/nifti: nifticlib is missing (Debian package libnifti-dev)".
std::vector<PluginProblem> not_built() {
  std::vector<PluginProblem> problems;
  std::ifstream in(Registry::home() + "/plugins_not_built.txt");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) problems.push_back({line.substr(0, colon), line.substr(colon + 2)});
  }
  return problems;
}

}  // namespace

bool Doctor::can_render() const {
  return std::any_of(backends.begin(), backends.end(), [](const BackendFinding& b) { return b.runs; });
}

CacheFinding examine_cache() {
  CacheFinding c;
  c.folder = cache_folder();
  std::error_code ec;
  fs::path there = c.folder;  // the folder, or the nearest one above it that exists: the first write makes the rest
  while (!fs::exists(there, ec) && there.has_relative_path()) there = there.parent_path();
  c.exists = there == fs::path(c.folder);
  if (!fs::is_directory(there, ec)) {
    c.problem = there.string() + " is no folder; set DVRLAB_CACHE to one";
  } else if (access(there.c_str(), W_OK | X_OK) != 0) {
    c.problem = there.string() + ": " + std::strerror(errno) + "; set DVRLAB_CACHE to a folder that can be written";
  }
  if (!c.exists) return c;
  for (const fs::directory_entry& e : fs::recursive_directory_iterator(there, ec)) {
    if (!e.is_regular_file(ec)) continue;
    ++c.files;
    c.bytes += e.file_size(ec);
  }
  return c;
}

Doctor examine(const Registry& registry) {
  Doctor d;
  d.backends = examine_backends(registry);
  d.modules = examine_modules(registry);
  d.folders = examine_folders(registry);
  d.missing_folders = registry.missing_roots();
  for (const PluginEntryInfo& e : registry.entries())
    if (e.descriptor == nullptr) d.broken.push_back({e.kind + "/" + e.name, e.problem});
  d.not_built = not_built();
  d.cache = examine_cache();
  try {
    const SystemMemory memory = system_memory();
    d.memory_total = memory.total;
    d.memory_available = memory.available;
  } catch (const NotSupported&) {  // stays 0: unknown
  }
  return d;
}

}  // namespace dvrlab
