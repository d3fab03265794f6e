// Finds plugin libraries by folder: <root>/<kind>/<name>/<name>.so. Opens the host libraries, never the kernel modules.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/interfaces/plugin.h"

namespace dvrlab {

struct PluginEntryInfo {
  std::string kind, name;
  std::string folder;   // that holds <name>.so
  std::string library;  // the file
  const PluginDescriptor* descriptor = nullptr;
  std::string problem;  // one sentence when it cannot be used; descriptor is nullptr then
};

/// A folder of DVRLAB_PLUGIN_PATH that is not there: an InputError, or a finding for who looks at the set-up itself.
enum class MissingRoots { refused, found };

class Registry {
 public:
  /// Search path: `extra` (--plugin-path), DVRLAB_PLUGIN_PATH (colon separated), then the tree of this library
  /// (build tree or install prefix). Throws InputError for a folder of `extra` that is not there.
  explicit Registry(const std::vector<std::string>& extra = {}, MissingRoots missing = MissingRoots::refused);

  const std::vector<std::string>& roots() const { return roots_; }
  /// MissingRoots::found: one sentence for each.
  const std::vector<std::string>& missing_roots() const { return missing_roots_; }
  const std::vector<PluginEntryInfo>& entries() const { return entries_; }

  /// Throws InputError: not found (kind, folders, nearest name, what is there), not loadable, ABI differs, duplicate.
  /// `path` is the config key that names the plugin ("" when there is none).
  const PluginEntryInfo& find(const std::string& kind, const std::string& name, const std::string& path = "") const;

  /// The plugin object (made once, kept). T must be the interface of `kind`.
  template <class T>
  T& get(const std::string& kind, const std::string& name, const std::string& path = "") const {
    return static_cast<T&>(object(find(kind, name, path)));
  }

  /// The kernel texts of the framework, beside the plugins: <lib>/dvrlab/kernel.
  static std::string kernel_folder();
  /// <lib>/dvrlab
  static std::string home();

 private:
  Plugin& object(const PluginEntryInfo& entry) const;
  void scan(const std::string& root);
  std::vector<std::string> roots_, missing_roots_;
  std::vector<PluginEntryInfo> entries_;
  mutable std::vector<std::pair<const PluginDescriptor*, std::unique_ptr<Plugin>>> objects_;
};

/// The element of `legal` nearest to `word` by edit distance; "" when nothing is near.
std::string nearest_name(const std::string& word, const std::vector<std::string>& legal);
/// " (did you mean 'direct'?)" for messages; "" when nothing is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& legal);

}  // namespace dvrlab
