// What `dvrlab doctor` says of Vulkan, and the names that result files use.
#pragma once

#include <string>

#include "backends/vulkan/loader.h"
#include "framework/interfaces/backend.h"

namespace dvrlab {

/// "1.3.230"
std::string version_text(std::uint32_t version);
/// The driver's own name and version where the device tells (Vulkan 1.2), else the version number.
std::string driver_text(VkPhysicalDevice device);

/// Every device, without opening one. Never throws: what is missing is the report's `problem`.
BackendReport vulkan_report();

}  // namespace dvrlab
