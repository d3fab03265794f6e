#include "backends/vulkan/context.h"

#include <string>
#include <vector>

#include "framework/interfaces/error.h"

namespace dvrlab {

VulkanContext::VulkanContext(VkPhysicalDevice physical) : physical_(physical) {
  vkGetPhysicalDeviceProperties(physical, &properties_);
  vkGetPhysicalDeviceMemoryProperties(physical, &memory_);
  choose_queue();
  try {
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo device{};
    device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device.queueCreateInfoCount = 1;
    device.pQueueCreateInfos = &queue;
    check(vkCreateDevice(physical, &device, nullptr, &device_), "creating the device");
    vkGetDeviceQueue(device_, family_, 0, &queue_);

    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = family_;
    check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "creating a command pool");
    VkCommandBufferAllocateInfo commands{};
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    commands.commandPool = pool_;
    commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device_, &commands, &commands_), "allocating a command buffer");
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    check(vkCreateFence(device_, &fence, nullptr, &fence_), "creating a fence");
  } catch (...) {
    release();
    throw;
  }
}

VulkanContext::~VulkanContext() { release(); }

void VulkanContext::release() {
  if (device_ == VK_NULL_HANDLE) return;
  vkDestroyFence(device_, fence_, nullptr);
  vkDestroyCommandPool(device_, pool_, nullptr);
  vkDestroyDevice(device_, nullptr);
}

void VulkanContext::choose_queue() {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  bool found = false;
  for (std::uint32_t f = 0; f < count; ++f) {
    if ((families[f].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) continue;
    if (found && (timestamp_bits_ != 0 || families[f].timestampValidBits == 0)) continue;
    found = true;
    family_ = f;
    timestamp_bits_ = families[f].timestampValidBits;
  }
}

void VulkanContext::run(const std::function<void(VkCommandBuffer)>& record) {
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands_, &begin), "recording commands");
  record(commands_);
  check(vkEndCommandBuffer(commands_), "recording commands");
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  check(vkQueueSubmit(queue_, 1, &submit, fence_), "submitting commands");
  check(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX), "waiting for the device");
  check(vkResetFences(device_, 1, &fence_), "waiting for the device");
}

void VulkanContext::check(VkResult result, const char* what) const {
  if (result >= 0) return;
  const std::string where = std::string(properties_.deviceName) + ", " + what + ": ";
  const std::string bytes = " (" + std::to_string(allocated) + " bytes of buffers in use)";
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      throw NotSupported(where + "the machine is out of memory" + bytes);
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      throw NotSupported(where + "the device is out of memory" + bytes);
    case VK_ERROR_DEVICE_LOST:
      throw std::runtime_error(where + "the device was lost" + bytes);
    default:
      throw std::runtime_error(where + "VkResult " + std::to_string(result) + bytes);
  }
}

}  // namespace dvrlab
