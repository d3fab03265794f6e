#define VOLK_IMPLEMENTATION
#include "backends/vulkan/loader.h"

#include "framework/interfaces/error.h"

namespace dvrlab {

void open_vulkan_loader() {
  static const VkResult opened = volkInitialize();
  if (opened != VK_SUCCESS)
    throw NotSupported("the Vulkan loader libvulkan.so.1 cannot be opened (Debian: libvulkan1)");
}

}  // namespace dvrlab
