// An OpenGL 4.5 core context without a display or a surface.
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <memory>
#include <string>
#include <vector>

#include "backends/opengl/gl_functions.h"

namespace dvrlab {

/// The functions of libEGL.so.1, opened at run time and never closed.
struct EglFunctions;

class EglContext;

/// One way to OpenGL without a display.
struct EglCandidate {
  std::string way;        // "EGL device 0", "surfaceless platform"
  int index = -1;         // of the EGL device, as a config's `device` names it; -1 for the surfaceless platform
  bool software = false;  // the EGL device says so itself
  std::unique_ptr<EglContext> context;
  std::string reason;  // why there is no context
};

/// The EGL library is there. Throws NotSupported when it is not installed.
void open_egl();

class EglContext {
 public:
  /// Every way, each tried. Throws NotSupported when EGL itself is missing.
  static std::vector<EglCandidate> all();
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
