// What a Vulkan device can bind and how its arithmetic behaves.
#pragma once

#include "backends/vulkan/loader.h"
#include "framework/shader/shader.h"

namespace dvrlab {

ShaderLimits shader_limits(VkPhysicalDevice device);

/// Bytes of the largest heap of the device's own memory.
std::uint64_t largest_heap(const VkPhysicalDeviceMemoryProperties& memory);

}  // namespace dvrlab
