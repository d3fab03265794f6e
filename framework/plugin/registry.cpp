#include "framework/plugin/registry.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "framework/config/words.h"
#include "framework/interfaces/error.h"
#include "framework/plugin/open_library.h"

namespace dvrlab {
namespace fs = std::filesystem;
namespace {

const char inside_this_library = 0;  // dladdr() tells which file it lies in

void add_root(std::vector<std::string>& roots, const std::string& folder, const char* from) {
  if (folder.empty()) return;
  std::error_code ec;
  if (!fs::is_directory(folder, ec)) {
    throw InputError(std::string(from) + ": there is no folder '" + folder + "'");
  }
  const std::string root = fs::canonical(folder).string();
  if (std::find(roots.begin(), roots.end(), root) == roots.end()) roots.push_back(root);
}

std::vector<std::string> folders_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code ec;
  for (const fs::directory_entry& e : fs::directory_iterator(folder, ec)) {
    if (e.is_directory(ec)) names.push_back(e.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void mark_duplicates(std::vector<PluginEntryInfo>& entries) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = i + 1; j < entries.size(); ++j) {
      if (entries[i].kind != entries[j].kind || entries[i].name != entries[j].name) continue;
      for (PluginEntryInfo* e : {&entries[i], &entries[j]}) {
        e->descriptor = nullptr;
        e->problem = "is there twice: " + entries[i].library + " and " + entries[j].library +
                     " (rename one, or take its root away)";
      }
    }
  }
}

}  // namespace

Registry::Registry(const std::vector<std::string>& extra, MissingRoots missing) {
  for (const std::string& folder : extra) add_root(roots_, folder, "--plugin-path");
  if (const char* path = std::getenv("DVRLAB_PLUGIN_PATH")) {
    for (const std::string& folder : split_words(path, ':')) {
      try {
        add_root(roots_, folder, "DVRLAB_PLUGIN_PATH");
      } catch (const InputError& e) {
        if (missing == MissingRoots::refused) throw;
        missing_roots_.emplace_back(e.what());
      }
    }
  }
  const std::string own = home() + "/plugins";
  if (fs::is_directory(own)) add_root(roots_, own, "dvrlab");
  for (const std::string& root : roots_) scan(root);
  mark_duplicates(entries_);
}

void Registry::scan(const std::string& root) {
  for (const char* kind : plugin_kinds) {
    for (const std::string& name : folders_in(root + "/" + kind)) {
      PluginEntryInfo entry{kind, name, root + "/" + kind + "/" + name, "", nullptr, ""};
      entry.library = entry.folder + "/" + name + ".so";
      std::error_code ec;
      if (!fs::exists(entry.library, ec)) {
        entry.problem = "has no library: " + entry.library + " is not there (build it)";
      } else {
        // One library that two roots reach (a link, a nested path) is one plugin.
        entry.library = fs::canonical(entry.library).string();
        const bool known = std::any_of(entries_.begin(), entries_.end(),
                                       [&](const PluginEntryInfo& e) { return e.library == entry.library; });
        if (known) continue;
        OpenedLibrary opened = open_library(entry.library, entry.kind, entry.name);
        entry.descriptor = opened.descriptor;
        entry.problem = std::move(opened.problem);
      }
      entries_.push_back(std::move(entry));
    }
  }
}

const PluginEntryInfo& Registry::find(const std::string& kind, const std::string& name, const std::string& path) const {
  const std::string where = path.empty() ? "" : path + ": ";
  std::vector<std::string> there;
  for (const PluginEntryInfo& e : entries_) {
    if (e.kind != kind) continue;
    if (e.name == name) {
      if (e.descriptor == nullptr) throw InputError(where + kind + " '" + name + "' " + e.problem);
      return e;
    }
    if (e.descriptor != nullptr) there.push_back(e.name);
  }
  std::sort(there.begin(), there.end());
  std::vector<std::string> searched;
  for (const std::string& root : roots_) searched.push_back(root + "/" + kind);
  throw InputError(where + "no " + kind + " '" + name + "' was found" + did_you_mean(name, there) +
                   (there.empty() ? "; there is none" : "; there are " + join_words(there)) +
                   (searched.empty() ? "; no plugin folder was found" : "; searched " + join_words(searched)));
}

Plugin& Registry::object(const PluginEntryInfo& entry) const {
  for (const auto& [descriptor, object] : objects_) {
    if (descriptor == entry.descriptor) return *object;
  }
  char error[256] = "no reason was given";
  std::unique_ptr<Plugin> made(entry.descriptor->create(error));
  if (!made) {
    throw NotSupported(entry.kind + " '" + entry.name + "' could not be made: " + error + " (" + entry.library + ")");
  }
  objects_.emplace_back(entry.descriptor, std::move(made));
  return *objects_.back().second;
}

std::string Registry::home() {
  Dl_info info{};
  if (dladdr(&inside_this_library, &info) == 0 || info.dli_fname == nullptr) {
    throw NotSupported("the folder of libdvrlab is unknown: the dynamic loader does not say where the library lies");
  }
  return (fs::canonical(info.dli_fname).parent_path() / "dvrlab").string();
}

std::string Registry::kernel_folder() { return home() + "/kernel"; }

}  // namespace dvrlab
