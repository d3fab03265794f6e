// A plugin of one's own, made from the template of its kind.
#pragma once

#include <string>
#include <vector>

#include "framework/plugin/registry.h"

namespace dvrlab {

struct NewPlugin {
  std::string folder;              // that was made
  std::vector<std::string> files;  // in it
  bool in_source_tree = false;     // built with dvrlab; otherwise the folder builds by itself
};

/// "" when `name` can be the name of a plugin; else what is wrong with it and what would be right.
std::string wrong_plugin_name(const std::string& name);

/// Copies the template of `kind` (<lib>/dvrlab/template/<kind>) and gives it its name. Below `out`, when that is not
/// empty, in <out>/<name>; inside of a source tree of dvrlab, as seen from the current folder, among its plugins; else
/// in ./<name>. A folder outside of a source tree gets a CMakeLists.txt of its own.
/// Throws InputError for an unknown kind, a bad or taken name, and a folder that exists: nothing is ever overwritten.
NewPlugin new_plugin(const std::string& kind, const std::string& name, const std::string& out,
                     const Registry& registry);

}  // namespace dvrlab
