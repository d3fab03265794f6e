// What a Vulkan device can bind and how its arithmetic behaves.
#pragma once

#include <vulkan/vulkan.h>

#include "framework/shader/shader.h"

namespace dvrlab {

ShaderLimits shader_limits(VkPhysicalDevice device);

}  // namespace dvrlab
