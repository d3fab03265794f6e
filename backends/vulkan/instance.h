// The Vulkan instance, its validation messages, and the choice of a device.
#pragma once

#include <string>
#include <vector>

#include "backends/vulkan/loader.h"

namespace dvrlab {

class VulkanInstance {
 public:
  /// Throws NotSupported when there is no driver, or with `validation` no validation layer.
  explicit VulkanInstance(bool validation);
  ~VulkanInstance();
  VulkanInstance(const VulkanInstance&) = delete;
  VulkanInstance& operator=(const VulkanInstance&) = delete;

  /// "" = the first discrete GPU, then integrated, virtual, CPU; else an index, or a part of a name in any case.
  /// Throws NotSupported listing what is there.
  VkPhysicalDevice choose(const std::string& wanted) const;
  /// All devices, in the order of their indices.
  std::vector<VkPhysicalDevice> devices() const;
  /// Validation messages since the last call.
  std::vector<std::string> take_messages() { return std::move(messages_); }

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::vector<std::string> messages_;
};

bool has_validation_layer();

/// "" or why the device cannot be used: too old, no compute queue.
std::string unusable(VkPhysicalDevice device);

}  // namespace dvrlab
