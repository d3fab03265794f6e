// A buffer with its own memory.
#pragma once

#include "backends/vulkan/context.h"
#include "backends/vulkan/loader.h"
#include "framework/shader/gpu_device.h"

namespace dvrlab {

class VulkanBuffer final : public GpuBuffer {
 public:
  /// `host`: visible to the CPU, for uniforms and copies. `device`: the device's own memory; where all of that is
  /// visible to the CPU too, it is mapped, and no copies are needed.
  enum class Place { host, device };
  VulkanBuffer(VulkanContext& context, VkBufferUsageFlags usage, Place place, std::uint64_t bytes);
  ~VulkanBuffer() override;
  VulkanBuffer(const VulkanBuffer&) = delete;
  VulkanBuffer& operator=(const VulkanBuffer&) = delete;
  VkBuffer handle() const { return buffer_; }
  /// nullptr when the CPU cannot reach the memory.
  std::byte* mapped() const { return mapped_; }

 private:
  void release();
  VulkanContext& context_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* mapped_ = nullptr;
};

/// True when every memory type of the device is visible to the CPU.
bool all_memory_is_visible(const VkPhysicalDeviceMemoryProperties& memory);

}  // namespace dvrlab
