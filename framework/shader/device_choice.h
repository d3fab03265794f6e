// How a config's `device` names a GPU.
#pragma once

#include <string>
#include <vector>

namespace dvrlab {

/// The index that `wanted` means: a whole number, or a part of a name in any case (the first that has it).
/// Throws NotSupported listing `names`. `interface_name` is "Vulkan" or "OpenGL".
int choose_device(const std::string& interface_name, const std::string& wanted, const std::vector<std::string>& names);

}  // namespace dvrlab
