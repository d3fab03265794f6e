// JSON text -> values and places. nlohmann's lexer and grammar; the tree, the places and the refusal of duplicate
// keys are ours.
#pragma once

#include <string>

#include "framework/config/config_tree.h"
#include "framework/config/problems.h"

namespace dvrlab {

/// `//` and block comments are allowed. Syntax errors, duplicate keys and nesting deeper than 64 are added to
/// `problems` with their place. `file` is what places are called.
ConfigTree read_json(const std::string& text, const std::string& file, Problems& problems);

}  // namespace dvrlab
