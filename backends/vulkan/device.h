// Vulkan as a GpuDevice.
#pragma once

#include <memory>
#include <string>

#include "backends/vulkan/buffer.h"
#include "backends/vulkan/instance.h"
#include "backends/vulkan/program.h"
#include "framework/shader/recent.h"

namespace dvrlab {

class VulkanDevice final : public GpuDevice {
 public:
  VulkanDevice(const std::string& device, bool validation);
  ~VulkanDevice() override;
  DeviceInfo info() const override;
  ShaderLimits limits() const override { return limits_; }
  std::uint64_t memory() const override;
  bool shares_memory() const override;
  void begin_frame() override {}
  void end_frame() override;
  std::unique_ptr<GpuBuffer> make_buffer(BufferUse use, std::uint64_t bytes) override;
  void write(GpuBuffer& buffer, const void* data, std::uint64_t bytes) override;
  void read(GpuBuffer& buffer, void* data, std::uint64_t bytes) override;
  void set_program(const Spirv& spirv, const std::vector<GpuBinding>& bindings) override;
  void bind(int binding, GpuBuffer& buffer) override;
  double dispatch(unsigned groups_x, unsigned groups_y) override;

 private:
  /// Memory that the CPU sees, for copies of up to staging_bytes at once.
  VulkanBuffer& staging();
  double elapsed() const;

  VulkanInstance instance_;
  VulkanContext context_;
  ShaderLimits limits_;
  std::unique_ptr<VulkanBuffer> staging_;
  RecentPrograms<std::unique_ptr<VulkanProgram>> programs_;
  VulkanProgram* program_ = nullptr;  // of them
  VkQueryPool queries_ = VK_NULL_HANDLE;
};

}  // namespace dvrlab
