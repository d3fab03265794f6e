#include "backends/vulkan/device.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "backends/vulkan/limits.h"
#include "backends/vulkan/report.h"

namespace dvrlab {
namespace {

constexpr std::uint64_t staging_bytes = 32u << 20;

void barrier(VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written, VkPipelineStageFlags to,
             VkAccessFlags read) {
  VkMemoryBarrier memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  memory.srcAccessMask = written;
  memory.dstAccessMask = read;
  vkCmdPipelineBarrier(commands, from, to, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

}  // namespace

VulkanDevice::VulkanDevice(const std::string& device, bool validation)
    : instance_(validation), context_(instance_.choose(device)), limits_(shader_limits(context_.physical())) {
  if (context_.timestamp_bits() == 0) return;
  VkQueryPoolCreateInfo queries{};
  queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = 2;
  context_.check(vkCreateQueryPool(context_.device(), &queries, nullptr, &queries_), "creating timestamps");
}

VulkanDevice::~VulkanDevice() { vkDestroyQueryPool(context_.device(), queries_, nullptr); }

DeviceInfo VulkanDevice::info() const {
  const VkPhysicalDeviceProperties& properties = context_.properties();
  DeviceInfo info;
  info.device = properties.deviceName;
  info.driver = driver_text(context_.physical());
  info.api = "Vulkan " + version_text(properties.apiVersion);
  info.detail = "storage buffers of " + std::to_string(limits_.buffer_range) + " bytes, " +
                std::to_string(limits_.storage_buffers) + " at once; march timed by " +
                (queries_ != VK_NULL_HANDLE ? "device timestamps" : "the wall clock");
  return info;
}

std::uint64_t VulkanDevice::memory() const { return largest_heap(context_.memory()); }

bool VulkanDevice::shares_memory() const { return all_memory_is_visible(context_.memory()); }

void VulkanDevice::end_frame() {
  const std::vector<std::string> messages = instance_.take_messages();
  if (messages.empty()) return;
  std::string text = "Vulkan validation says:";
  for (const std::string& message : messages) text += "\n" + message;
  throw std::runtime_error(text);
}

std::unique_ptr<GpuBuffer> VulkanDevice::make_buffer(BufferUse use, std::uint64_t bytes) {
  switch (use) {
    case BufferUse::uniform:
      return std::make_unique<VulkanBuffer>(context_, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, VulkanBuffer::Place::host,
                                            bytes);
    case BufferUse::storage:
      return std::make_unique<VulkanBuffer>(context_,
                                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                            VulkanBuffer::Place::device, bytes);
    case BufferUse::output:
      return std::make_unique<VulkanBuffer>(context_,
                                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                            VulkanBuffer::Place::device, bytes);
  }
  throw std::logic_error("buffer of an unknown use");
}

VulkanBuffer& VulkanDevice::staging() {
  if (!staging_)
    staging_ =
        std::make_unique<VulkanBuffer>(context_, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                       VulkanBuffer::Place::host, staging_bytes);
  return *staging_;
}

void VulkanDevice::write(GpuBuffer& buffer, const void* data, std::uint64_t bytes) {
  const auto& target = static_cast<const VulkanBuffer&>(buffer);
  const auto* source = static_cast<const std::byte*>(data);
  // Copies `size` bytes from `at` on; zeros where the data have ended.
  const auto fill = [&](std::byte* to, std::uint64_t at, std::uint64_t size) {
    const std::uint64_t given = at < bytes ? std::min(size, bytes - at) : 0;
    if (given != 0) std::memcpy(to, source + at, given);
    std::memset(to + given, 0, size - given);
  };
  if (target.mapped() != nullptr) return fill(target.mapped(), 0, target.bytes());
  for (std::uint64_t at = 0; at < target.bytes(); at += staging_bytes) {
    const std::uint64_t size = std::min(staging_bytes, target.bytes() - at);
    fill(staging().mapped(), at, size);
    context_.run([&](VkCommandBuffer commands) {
      const VkBufferCopy copy{0, at, size};
      vkCmdCopyBuffer(commands, staging().handle(), target.handle(), 1, &copy);
      barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
              VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
    });
  }
}

void VulkanDevice::read(GpuBuffer& buffer, void* data, std::uint64_t bytes) {
  const auto& source = static_cast<const VulkanBuffer&>(buffer);
  if (source.mapped() != nullptr) {
    std::memcpy(data, source.mapped(), bytes);
    return;
  }
  for (std::uint64_t at = 0; at < bytes; at += staging_bytes) {
    const std::uint64_t size = std::min(staging_bytes, bytes - at);
    context_.run([&](VkCommandBuffer commands) {
      const VkBufferCopy copy{at, 0, size};
      vkCmdCopyBuffer(commands, source.handle(), staging().handle(), 1, &copy);
      barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
              VK_ACCESS_HOST_READ_BIT);
    });
    std::memcpy(static_cast<std::byte*>(data) + at, staging().mapped(), size);
  }
}

void VulkanDevice::set_program(const Spirv& spirv, const std::vector<GpuBinding>& bindings) {
  program_ = programs_.use(spirv, [&] { return std::make_unique<VulkanProgram>(context_, spirv, bindings); }).get();
}

void VulkanDevice::bind(int binding, GpuBuffer& buffer) {
  program_->bind(binding, static_cast<const VulkanBuffer&>(buffer).handle());
}

double VulkanDevice::dispatch(unsigned groups_x, unsigned groups_y) {
  context_.run([&](VkCommandBuffer commands) {
    if (queries_ != VK_NULL_HANDLE) {
      vkCmdResetQueryPool(commands, queries_, 0, 2);
      vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, queries_, 0);
    }
    program_->record(commands, groups_x, groups_y);
    if (queries_ != VK_NULL_HANDLE) vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_, 1);
    barrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_HOST_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT);
  });
  return queries_ != VK_NULL_HANDLE ? elapsed() : -1.0;
}

double VulkanDevice::elapsed() const {
  std::uint64_t ticks[2] = {};
  context_.check(vkGetQueryPoolResults(context_.device(), queries_, 0, 2, sizeof(ticks), ticks, sizeof(ticks[0]),
                                       VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                 "reading timestamps");
  const std::uint32_t bits = context_.timestamp_bits();
  const std::uint64_t valid = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  return double((ticks[1] - ticks[0]) & valid) * double(context_.properties().limits.timestampPeriod) * 1e-9;
}

}  // namespace dvrlab
