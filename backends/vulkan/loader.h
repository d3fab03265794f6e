// The Vulkan loader, libvulkan.so.1, opened at run time by volk: nothing is linked, so a machine without Vulkan can
// still load the plugin and be told what is missing. Every vk... function is a pointer that volk fills.
#pragma once

#include <volk.h>

namespace dvrlab {

/// Opens the library once. Throws NotSupported when it is not installed.
void open_vulkan_loader();

}  // namespace dvrlab
