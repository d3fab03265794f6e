// The plugins stage: every section of a config meets the declarations of its plugin. Defaults are filled in, and
// whatever was not declared is refused.
#pragma once

#include "framework/config/config_tree.h"
#include "framework/config/problems.h"
#include "framework/config/resolved_case.h"
#include "framework/config/sections.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

/// What a section may hold: the declared keys, and how structures among them are judged.
struct Declaration {
  std::vector<Parameter> keys;
  std::vector<JsonShape> shapes;
  std::vector<std::string> also;  // keys that are legal here but read by somebody else ("type")
};

/// The section at `path` with defaults filled in. Unknown keys, missing keys and illegal values are added to
/// `problems`; the result is complete only when none was. `resolved` receives the values as JSON.
ParameterSet resolve_keys(const ConfigTree& tree, const std::string& path, const Declaration& declaration,
                          Problems& problems, nlohmann::json& resolved);

/// The `data` section alone, for those who only want the data. Everything wrong is added to `problems`.
Section resolve_data(const ConfigTree& tree, const Registry& registry, Problems& problems);

/// One case: the tree without the experiment's own sections (include, axes, reference, expect), which are ignored.
/// Everything wrong is added to `problems`; the case may be used only when nothing was.
ResolvedCase resolve_case(const ConfigTree& tree, const std::string& base_folder, const Registry& registry,
                          Problems& problems);

}  // namespace dvrlab
