#include "backends/vulkan/buffer.h"

#include <algorithm>
#include <bit>
#include <span>
#include <stdexcept>

namespace dvrlab {
namespace {

constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

std::span<const VkMemoryType> types_of(const VkPhysicalDeviceMemoryProperties& memory) {
  return {memory.memoryTypes, memory.memoryTypeCount};
}

/// How well a memory type serves; < 0: not at all. Small device-local windows that the CPU sees are left to drivers.
int score(VkMemoryPropertyFlags flags, VulkanBuffer::Place place) {
  const bool is_local = (flags & local) != 0, is_visible = (flags & visible) == visible,
             is_cached = (flags & cached) != 0;
  if (place == VulkanBuffer::Place::host) return is_visible ? 2 * is_cached + !is_local : -1;
  return 4 * is_local + 2 * ((flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) + is_cached;
}

}  // namespace

bool all_memory_is_visible(const VkPhysicalDeviceMemoryProperties& memory) {
  const auto types = types_of(memory);
  return std::all_of(types.begin(), types.end(),
                     [](const VkMemoryType& t) { return (t.propertyFlags & visible) == visible; });
}

VulkanBuffer::VulkanBuffer(VulkanContext& context, VkBufferUsageFlags usage, Place place, std::uint64_t bytes)
    : GpuBuffer(bytes), context_(context) {
  VkBufferCreateInfo create{};
  create.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  create.size = bytes;
  create.usage = usage;
  context.check(vkCreateBuffer(context.device(), &create, nullptr, &buffer_), "creating a buffer");
  try {
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(context.device(), buffer_, &needs);
    const auto types = types_of(context.memory());
    int best = -1, best_score = -1;
    for (int t = 0; t < int(types.size()); ++t) {
      if ((needs.memoryTypeBits >> t & 1) == 0) continue;
      const int s = score(types[std::size_t(t)].propertyFlags, place);
      if (s > best_score) best = t, best_score = s;
    }
    if (best < 0) throw std::runtime_error("the Vulkan device has no memory for a buffer of this use");
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = std::uint32_t(best);
    context.check(vkAllocateMemory(context.device(), &allocate, nullptr, &memory_),
                  ("allocating " + std::to_string(needs.size) + " bytes").c_str());
    context.check(vkBindBufferMemory(context.device(), buffer_, memory_, 0), "binding memory");
    if ((types[std::size_t(best)].propertyFlags & visible) == visible) {
      void* address = nullptr;
      context.check(vkMapMemory(context.device(), memory_, 0, VK_WHOLE_SIZE, 0, &address), "mapping memory");
      mapped_ = static_cast<std::byte*>(address);
    }
  } catch (...) {
    release();
    throw;
  }
  context.allocated += bytes;
}

VulkanBuffer::~VulkanBuffer() {
  release();
  context_.allocated -= bytes();
}

void VulkanBuffer::release() {
  vkDestroyBuffer(context_.device(), buffer_, nullptr);
  vkFreeMemory(context_.device(), memory_, nullptr);
}

}  // namespace dvrlab
