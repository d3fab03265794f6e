// A compute pipeline with its descriptors.
#pragma once

#include "backends/vulkan/context.h"
#include "backends/vulkan/loader.h"
#include "framework/shader/gpu_device.h"

namespace dvrlab {

class VulkanProgram {
 public:
  /// Pipelines are kept in the disk cache between processes.
  VulkanProgram(VulkanContext& context, const Spirv& spirv, const std::vector<GpuBinding>& bindings);
  ~VulkanProgram();
  VulkanProgram(const VulkanProgram&) = delete;
  VulkanProgram& operator=(const VulkanProgram&) = delete;
  void bind(int binding, VkBuffer buffer);
  void record(VkCommandBuffer commands, unsigned groups_x, unsigned groups_y) const;

 private:
  void make_descriptors();
  void make_pipeline(const Spirv& spirv);
  void release();
  VulkanContext& context_;
  std::vector<GpuBinding> bindings_;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkShaderModule module_ = VK_NULL_HANDLE;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace dvrlab
