// Which data plugin reads a file or a folder.
#pragma once

#include <string>
#include <vector>

#include "framework/plugin/registry.h"

namespace dvrlab {

/// The names of the data plugins that recognise `path`. Empty when none does. Throws InputError when there is no such
/// file or folder.
std::vector<std::string> readers_of(const std::string& path, const Registry& registry);

/// The one that reads it. Throws InputError, naming the formats that are read, when there is none or more than one.
std::string reader_of(const std::string& path, const Registry& registry);

}  // namespace dvrlab
