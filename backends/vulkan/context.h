// A logical device with one compute queue: what buffers and programs are made of.
#pragma once

#include <cstdint>
#include <functional>

#include "backends/vulkan/loader.h"

namespace dvrlab {

class VulkanContext {
 public:
  explicit VulkanContext(VkPhysicalDevice physical);
  ~VulkanContext();
  VulkanContext(const VulkanContext&) = delete;
  VulkanContext& operator=(const VulkanContext&) = delete;

  VkPhysicalDevice physical() const { return physical_; }
  VkDevice device() const { return device_; }
  const VkPhysicalDeviceProperties& properties() const { return properties_; }
  const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
  /// Of the queue's timestamps; 0: it has none.
  std::uint32_t timestamp_bits() const { return timestamp_bits_; }
  /// Records commands, submits them and waits until they are done.
  void run(const std::function<void(VkCommandBuffer)>& record);
  /// Throws when `result` is an error: NotSupported for memory, std::runtime_error else, with the bytes in use.
  void check(VkResult result, const char* what) const;
  /// Bytes of the buffers that exist now.
  std::uint64_t allocated = 0;

 private:
  void choose_queue();
  void release();
  VkPhysicalDevice physical_;
  VkPhysicalDeviceProperties properties_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  std::uint32_t family_ = 0, timestamp_bits_ = 0;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
};

}  // namespace dvrlab
