#include "backends/vulkan/limits.h"

#include <algorithm>

namespace dvrlab {

ShaderLimits shader_limits(VkPhysicalDevice device) {
  constexpr std::uint32_t plenty = 1u << 20, uniform_blocks = 4;
  VkPhysicalDeviceFloatControlsProperties arithmetic{};
  arithmetic.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES;
  VkPhysicalDeviceMaintenance3Properties allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  VkPhysicalDeviceProperties2 all{};
  all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  all.pNext = &allocation;
  vkGetPhysicalDeviceProperties2(device, &all);
  const bool has_float_controls = all.properties.apiVersion >= VK_API_VERSION_1_2;
  if (has_float_controls) {
    all.pNext = &arithmetic;
    vkGetPhysicalDeviceProperties2(device, &all);
  }
  const VkPhysicalDeviceLimits& limits = all.properties.limits;
  ShaderLimits result;
  result.target = ShaderTarget::vulkan;
  result.buffer_range = std::min<std::uint64_t>(limits.maxStorageBufferRange, allocation.maxMemoryAllocationSize);
  result.runs_both_branches = all.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  result.uniform_range = limits.maxUniformBufferRange;
  result.storage_buffers =
      int(std::min({limits.maxPerStageDescriptorStorageBuffers, limits.maxDescriptorSetStorageBuffers,
                    limits.maxPerStageResources - uniform_blocks, plenty}));
  if (arithmetic.shaderDenormPreserveFloat32) result.float_modes.push_back(FloatMode::denorm_preserve);
  if (arithmetic.shaderSignedZeroInfNanPreserveFloat32)
    result.float_modes.push_back(FloatMode::signed_zero_inf_nan_preserve);
  if (arithmetic.shaderRoundingModeRTEFloat32) result.float_modes.push_back(FloatMode::rounding_rte);
  return result;
}

std::uint64_t largest_heap(const VkPhysicalDeviceMemoryProperties& memory) {
  std::uint64_t bytes = 0;
  for (std::uint32_t h = 0; h < memory.memoryHeapCount; ++h)
    if ((memory.memoryHeaps[h].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
      bytes = std::max(bytes, memory.memoryHeaps[h].size);
  return bytes;
}

}  // namespace dvrlab
