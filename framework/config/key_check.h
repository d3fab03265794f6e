// Keys that could be taken for something else: "" and "size." would vanish in a key path, "size[0]" looks like one.
#pragma once

#include <string>

#include "framework/config/config_tree.h"
#include "framework/config/problems.h"

namespace dvrlab {

/// Key paths name keys in axes, references and `where` only, each of steps that are not empty; everywhere else a key is
/// one step. What is otherwise is added to `problems`. `config` is the path of the config in the tree: "" for the root.
void check_keys(const ConfigTree& tree, const std::string& config, Problems& problems);

}  // namespace dvrlab
