// --set: one key of a config from the command line.
#pragma once

#include <string>

#include "framework/config/config_tree.h"

namespace dvrlab {

/// "key.path=value" over the tree; a value that is no JSON is a text. Below "axes.permutation." and "axes.variant."
/// the rest is the axis' key path; zipped keys are "axes.permutation.zip[0].<key path>".
/// Throws InputError for a key that an axis decides and for one that has no place in the tree.
void override_key(ConfigTree& tree, const std::string& assignment);

}  // namespace dvrlab
