# EGL and OpenGL are loaded at run time: only their headers are needed here.
find_path(DVRLAB_EGL_INCLUDE EGL/egl.h)
find_path(DVRLAB_GL_INCLUDE GL/glcorearb.h)
if(NOT DVRLAB_EGL_INCLUDE OR NOT DVRLAB_GL_INCLUDE)
  set(DVRLAB_SKIP "EGL or OpenGL headers missing (Debian: libegl-dev, libgl-dev)")
elseif(NOT TARGET dvrlab::shader)
  set(DVRLAB_SKIP "glslang missing (Debian: glslang-dev, glslang-tools)")
else()
  target_include_directories(${DVRLAB_TARGET} SYSTEM PRIVATE ${DVRLAB_EGL_INCLUDE} ${DVRLAB_GL_INCLUDE})
  target_link_libraries(${DVRLAB_TARGET} PRIVATE dvrlab::shader ${CMAKE_DL_LIBS})
  # No window system: the headers must not ask for X11.
  target_compile_definitions(${DVRLAB_TARGET} PRIVATE EGL_NO_X11 EGL_NO_PLATFORM_SPECIFIC_TYPES)
endif()
