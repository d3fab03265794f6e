find_package(Vulkan QUIET) if (NOT Vulkan_FOUND)
    set(DVRLAB_SKIP "Vulkan headers or loader missing (Debian: libvulkan-dev)") elseif(NOT TARGET dvrlab_shader)
        set(DVRLAB_SKIP "glslang missing (Debian: glslang-dev, glslang-tools)") else()
            target_link_libraries(${DVRLAB_TARGET} PRIVATE dvrlab_shader Vulkan::Vulkan) endif()
