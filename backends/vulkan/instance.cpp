#include "backends/vulkan/instance.h"

#include <algorithm>
#include <cstring>

#include "framework/interfaces/error.h"
#include "framework/shader/device_choice.h"

namespace dvrlab {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  static_cast<std::vector<std::string>*>(messages)->push_back(data->pMessage);
  return VK_FALSE;
}

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 3;
    default:
      return 4;
  }
}

}  // namespace

bool has_validation_layer() {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(),
                     [](const VkLayerProperties& l) { return std::strcmp(l.layerName, validation_layer) == 0; });
}

std::string unusable(VkPhysicalDevice device) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  const std::string name = std::string("the Vulkan device ") + properties.deviceName;
  if (properties.apiVersion < VK_API_VERSION_1_1) return name + " is older than version 1.1";
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  const bool computes = std::any_of(families.begin(), families.end(), [](const VkQueueFamilyProperties& f) {
    return (f.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0;
  });
  return computes ? "" : name + " has no compute queue";
}

VulkanInstance::VulkanInstance(bool validation) {
  open_vulkan_loader();
  if (volkGetInstanceVersion() < VK_API_VERSION_1_1) throw NotSupported("the Vulkan loader is older than version 1.1");
  if (validation && !has_validation_layer())
    throw NotSupported(std::string("the layer ") + validation_layer +
                       " is not installed (Debian: vulkan-validationlayers); set backend.validation to false");

  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "dvrlab";
  application.apiVersion = VK_API_VERSION_1_2;  // the highest version that is used where a device has it
  const VkValidationFeatureEnableEXT enabled = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &enabled;
  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  messenger.pNext = &features;
  messenger.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback = collect;
  messenger.pUserData = &messages_;
  const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  VkInstanceCreateInfo create{};
  create.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  create.pApplicationInfo = &application;
  if (validation) {
    create.pNext = &messenger;
    create.enabledLayerCount = 1;
    create.ppEnabledLayerNames = &validation_layer;
    create.enabledExtensionCount = 2;
    create.ppEnabledExtensionNames = extensions;
  }
  const VkResult made = vkCreateInstance(&create, nullptr, &instance_);
  if (made == VK_ERROR_INCOMPATIBLE_DRIVER)
    throw NotSupported("no Vulkan driver was found (Debian: mesa-vulkan-drivers has drivers and a software GPU)");
  if (made != VK_SUCCESS)
    throw NotSupported("a Vulkan instance cannot be created (VkResult " + std::to_string(made) + ")");
  volkLoadInstance(instance_);
  if (!validation) return;
  const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  messenger.pNext = nullptr;
  if (create_messenger == nullptr || create_messenger(instance_, &messenger, nullptr, &messenger_) != VK_SUCCESS) {
    vkDestroyInstance(instance_, nullptr);
    throw NotSupported("the Vulkan validation layer gives no messages on this system");
  }
}

VulkanInstance::~VulkanInstance() {
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

std::vector<VkPhysicalDevice> VulkanInstance::devices() const {
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance_, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(instance_, &count, devices.data());
  devices.resize(count);
  return devices;
}

VkPhysicalDevice VulkanInstance::choose(const std::string& wanted) const {
  const std::vector<VkPhysicalDevice> devices = this->devices();
  if (devices.empty()) throw NotSupported("the Vulkan drivers offer no device");
  std::vector<std::string> names;
  int best = 0, best_rank = 5;
  for (int d = 0; d < int(devices.size()); ++d) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(devices[std::size_t(d)], &properties);
    names.push_back(properties.deviceName);
    if (rank(properties.deviceType) < best_rank) best = d, best_rank = rank(properties.deviceType);
  }
  const int chosen = wanted.empty() ? best : choose_device("Vulkan", wanted, names);
  if (const std::string reason = unusable(devices[std::size_t(chosen)]); !reason.empty()) throw NotSupported(reason);
  return devices[std::size_t(chosen)];
}

}  // namespace dvrlab
