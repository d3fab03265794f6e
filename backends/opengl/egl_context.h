// An OpenGL 4.5 core context without a display or a surface.
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <memory>
#include <string>

#include "backends/opengl/gl_functions.h"

namespace dvrlab {

/// The functions of libEGL.so.1, opened at run time and never closed.
struct EglFunctions;

class EglContext {
 public:
  /// "" = the first EGL device that is no software renderer, then the surfaceless platform, then a software device;
  /// else an index of the EGL devices or a part of GL_RENDERER in any case. Throws NotSupported with the reasons.
  static std::unique_ptr<EglContext> open(const std::string& device, bool debug);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  void make_current() const;
  const GlFunctions& gl() const { return gl_; }

 private:
  EglContext(const EglFunctions& egl, EGLDisplay display, bool debug);
  void load();
  const EglFunctions& egl_;
  EGLDisplay display_;  // shared by the contexts of a process, so it is never terminated
  EGLContext context_ = EGL_NO_CONTEXT;
  GlFunctions gl_;
};

}  // namespace dvrlab
