#include "backends/vulkan/report.h"

#include <algorithm>

#include "backends/vulkan/context.h"
#include "backends/vulkan/instance.h"
#include "backends/vulkan/limits.h"
#include "framework/interfaces/error.h"
#include "framework/report/byte_text.h"

namespace dvrlab {
namespace {

const char* type_text(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "software on the processor";
    default:
      return "other";
  }
}

/// What the device keeps of IEEE arithmetic without being asked: where it is silent, equal bits are not promised.
std::string arithmetic_text(const ShaderLimits& limits) {
  std::string text;
  const auto add = [&](FloatMode mode, const char* word) {
    const auto& modes = limits.float_modes;
    if (std::find(modes.begin(), modes.end(), mode) != modes.end()) text.append(text.empty() ? "" : ", ").append(word);
  };
  add(FloatMode::denorm_preserve, "keeps denormals");
  add(FloatMode::signed_zero_inf_nan_preserve, "keeps signed zeros, infinities and NaNs");
  add(FloatMode::rounding_rte, "rounds to nearest even");
  return text.empty() ? "the driver promises nothing" : text;
}

DeviceReport device_report(VkPhysicalDevice device, int index) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  DeviceReport r;
  r.name = properties.deviceName;
  r.driver = driver_text(device);
  r.api = "Vulkan " + version_text(properties.apiVersion);
  r.software = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  r.property = {{"index", std::to_string(index)}, {"type", type_text(properties.deviceType)}};
  if (const std::string reason = unusable(device); !reason.empty()) {
    r.property.emplace_back("unusable", reason);
    return r;
  }
  const ShaderLimits limits = shader_limits(device);
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  const auto& size = properties.limits.maxComputeWorkGroupSize;
  r.property.insert(
      r.property.end(),
      {{"storage buffer", byte_text(limits.buffer_range)},
       {"storage buffers at once", std::to_string(limits.storage_buffers)},
       {"uniform block", byte_text(limits.uniform_range)},
       {"workgroup", std::to_string(properties.limits.maxComputeWorkGroupInvocations) + " invocations, " +
                         std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2])},
       {"memory", byte_text(largest_heap(memory))},
       {"arithmetic", arithmetic_text(limits)},
       {"validation layer", has_validation_layer() ? "installed"
                                                   : "not installed (Debian: vulkan-validationlayers); only "
                                                     "\"validation\": true needs it"}});
  return r;
}

}  // namespace

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::string driver_text(VkPhysicalDevice device) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  if (properties.apiVersion < VK_API_VERSION_1_2) return version_text(properties.driverVersion);
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 chain{};
  chain.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  chain.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &chain);
  return std::string(driver.driverName) + " " + driver.driverInfo;
}

BackendReport vulkan_report() {
  BackendReport report;
  try {
    report.package = "libvulkan1";
    open_vulkan_loader();
    report.package = "mesa-vulkan-drivers";
    const VulkanInstance instance(false);
    const std::vector<VkPhysicalDevice> devices = instance.devices();
    bool usable_device = false;
    for (std::size_t d = 0; d < devices.size(); ++d) {
      report.device.push_back(device_report(devices[d], int(d)));
      usable_device = usable_device || unusable(devices[d]).empty();
    }
    if (devices.empty()) {
      report.problem = "the Vulkan drivers offer no device";
    } else {
      report.package = "";
      if (!usable_device) report.problem = "no Vulkan device is usable: " + unusable(devices[0]);
    }
  } catch (const NotSupported& e) {
    report.problem = e.what();
  }
  return report;
}

}  // namespace dvrlab
