#include "backends/vulkan/program.h"

#include <algorithm>
#include <cstdio>

#include "framework/shader/disk_cache.h"

namespace dvrlab {
namespace {

VkDescriptorType descriptor_type(BufferUse use) {
  return use == BufferUse::uniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

/// One file per driver build: the driver refuses another one's data by this identifier.
std::string cache_file(const VkPhysicalDeviceProperties& properties) {
  std::string name;
  for (const std::uint8_t byte : properties.pipelineCacheUUID) {
    char digits[3];
    std::snprintf(digits, sizeof(digits), "%02x", byte);
    name += digits;
  }
  return name + ".bin";
}

}  // namespace

VulkanProgram::VulkanProgram(VulkanContext& context, const Spirv& spirv, const std::vector<GpuBinding>& bindings)
    : context_(context), bindings_(bindings) {
  try {
    make_descriptors();
    make_pipeline(spirv);
  } catch (...) {
    release();
    throw;
  }
}

VulkanProgram::~VulkanProgram() { release(); }

void VulkanProgram::release() {
  const VkDevice device = context_.device();
  vkDestroyPipeline(device, pipeline_, nullptr);
  vkDestroyPipelineCache(device, cache_, nullptr);
  vkDestroyShaderModule(device, module_, nullptr);
  vkDestroyPipelineLayout(device, layout_, nullptr);
  vkDestroyDescriptorPool(device, pool_, nullptr);
  vkDestroyDescriptorSetLayout(device, set_layout_, nullptr);
}

void VulkanProgram::make_descriptors() {
  std::vector<VkDescriptorSetLayoutBinding> slots;
  VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 0}, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 0}};
  for (const GpuBinding& b : bindings_) {
    slots.push_back({std::uint32_t(b.binding), descriptor_type(b.use), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    ++sizes[b.use == BufferUse::uniform ? 0 : 1].descriptorCount;
  }
  VkDescriptorSetLayoutCreateInfo layout{};
  layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  layout.bindingCount = std::uint32_t(slots.size());
  layout.pBindings = slots.data();
  context_.check(vkCreateDescriptorSetLayout(context_.device(), &layout, nullptr, &set_layout_),
                 "creating a set layout");
  VkDescriptorPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool.maxSets = 1;
  pool.poolSizeCount = 2;
  pool.pPoolSizes = sizes;
  context_.check(vkCreateDescriptorPool(context_.device(), &pool, nullptr, &pool_), "creating a descriptor pool");
  VkDescriptorSetAllocateInfo set{};
  set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  set.descriptorPool = pool_;
  set.descriptorSetCount = 1;
  set.pSetLayouts = &set_layout_;
  context_.check(vkAllocateDescriptorSets(context_.device(), &set, &set_), "allocating descriptors");
}

void VulkanProgram::make_pipeline(const Spirv& spirv) {
  const VkDevice device = context_.device();
  VkPipelineLayoutCreateInfo layout{};
  layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &set_layout_;
  context_.check(vkCreatePipelineLayout(device, &layout, nullptr, &layout_), "creating a pipeline layout");
  VkShaderModuleCreateInfo module{};
  module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module.codeSize = spirv.size() * sizeof(std::uint32_t);
  module.pCode = spirv.data();
  context_.check(vkCreateShaderModule(device, &module, nullptr, &module_), "creating a shader module");

  const DiskCache disk("vulkan");
  const std::string file = cache_file(context_.properties());
  const std::vector<std::byte> known = disk.read(file).value_or(std::vector<std::byte>{});
  VkPipelineCacheCreateInfo cache{};
  cache.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  cache.initialDataSize = known.size();
  cache.pInitialData = known.data();
  context_.check(vkCreatePipelineCache(device, &cache, nullptr, &cache_), "creating a pipeline cache");

  VkComputePipelineCreateInfo pipeline{};
  pipeline.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  pipeline.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  pipeline.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  pipeline.stage.module = module_;
  pipeline.stage.pName = "main";
  pipeline.layout = layout_;
  context_.check(vkCreateComputePipelines(device, cache_, 1, &pipeline, nullptr, &pipeline_), "compiling the shader");

  std::size_t bytes = 0;
  context_.check(vkGetPipelineCacheData(device, cache_, &bytes, nullptr), "reading the pipeline cache");
  std::vector<std::byte> data(bytes);
  context_.check(vkGetPipelineCacheData(device, cache_, &bytes, data.data()), "reading the pipeline cache");
  data.resize(bytes);
  if (data != known) disk.write(file, data);
}

void VulkanProgram::bind(int binding, VkBuffer buffer) {
  const auto slot =
      std::find_if(bindings_.begin(), bindings_.end(), [&](const GpuBinding& b) { return b.binding == binding; });
  const VkDescriptorBufferInfo info{buffer, 0, VK_WHOLE_SIZE};
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.dstBinding = std::uint32_t(binding);
  write.descriptorCount = 1;
  write.descriptorType = descriptor_type(slot->use);
  write.pBufferInfo = &info;
  vkUpdateDescriptorSets(context_.device(), 1, &write, 0, nullptr);
}

void VulkanProgram::record(VkCommandBuffer commands, unsigned groups_x, unsigned groups_y) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
  vkCmdDispatch(commands, groups_x, groups_y, 1);
}

}  // namespace dvrlab
