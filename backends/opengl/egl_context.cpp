#include "backends/opengl/egl_context.h"

#include <dlfcn.h>

#include <sstream>
#include <vector>

#include "framework/interfaces/error.h"
#include "framework/shader/device_choice.h"

namespace dvrlab {

#define DVRLAB_EGL_FUNCTIONS(X)               \
  X(PFNEGLGETPROCADDRESSPROC, GetProcAddress) \
  X(PFNEGLQUERYSTRINGPROC, QueryString)       \
  X(PFNEGLINITIALIZEPROC, Initialize)         \
  X(PFNEGLBINDAPIPROC, BindAPI)               \
  X(PFNEGLCREATECONTEXTPROC, CreateContext)   \
  X(PFNEGLDESTROYCONTEXTPROC, DestroyContext) \
  X(PFNEGLMAKECURRENTPROC, MakeCurrent)       \
  X(PFNEGLGETCURRENTCONTEXTPROC, GetCurrentContext)

struct EglFunctions {
#define DVRLAB_EGL_MEMBER(type, name) type name = nullptr;
  DVRLAB_EGL_FUNCTIONS(DVRLAB_EGL_MEMBER)
#undef DVRLAB_EGL_MEMBER
  template <class F>
  F extension(const char* name) const {
    return reinterpret_cast<F>(GetProcAddress(name));
  }
};

namespace {

const EglFunctions& egl_functions() {
  static const EglFunctions functions = [] {
    void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
      throw NotSupported(std::string("EGL cannot be loaded: ") + dlerror() + " (Debian: libegl1)");
    EglFunctions egl;
#define DVRLAB_EGL_LOAD(type, name)                               \
  egl.name = reinterpret_cast<type>(dlsym(library, "egl" #name)); \
  if (egl.name == nullptr) throw NotSupported("libEGL.so.1 lacks egl" #name);
    DVRLAB_EGL_FUNCTIONS(DVRLAB_EGL_LOAD)
#undef DVRLAB_EGL_LOAD
    return egl;
  }();
  return functions;
}

/// True when the blank-separated list holds the word.
bool has_word(const char* list, const std::string& word) {
  std::istringstream in(list != nullptr ? list : "");
  for (std::string next; in >> next;)
    if (next == word) return true;
  return false;
}

struct EglDevice {
  EGLDisplay display;
  bool software;
};

/// The displays of EGL_EXT_platform_device; none where the extension is missing.
std::vector<EglDevice> egl_devices(const EglFunctions& egl, const char* client) {
  const auto query = egl.extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto text = egl.extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  const auto display = egl.extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (!has_word(client, "EGL_EXT_platform_device") || query == nullptr || text == nullptr || display == nullptr)
    return {};
  EGLint count = 0;
  if (!query(0, nullptr, &count)) return {};
  std::vector<EGLDeviceEXT> handles(static_cast<std::size_t>(count));
  query(count, handles.data(), &count);
  std::vector<EglDevice> devices;
  for (EGLDeviceEXT handle : handles)
    devices.push_back({display(EGL_PLATFORM_DEVICE_EXT, handle, nullptr),
                       has_word(text(handle, EGL_EXTENSIONS), "EGL_MESA_device_software")});
  return devices;
}

}  // namespace

void open_egl() { egl_functions(); }

std::vector<EglCandidate> EglContext::all() {
  const EglFunctions& egl = egl_functions();
  const char* client = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<EglCandidate> candidates;
  const auto attempt = [&](EglCandidate candidate, EGLDisplay display) {
    try {
      candidate.context.reset(new EglContext(egl, display, false));
    } catch (const NotSupported& e) {
      candidate.reason = e.what();
    }
    candidates.push_back(std::move(candidate));
  };
  const std::vector<EglDevice> devices = egl_devices(egl, client);
  for (std::size_t d = 0; d < devices.size(); ++d)
    attempt({"EGL device " + std::to_string(d), int(d), devices[d].software, nullptr, ""}, devices[d].display);
  const auto platform_display = egl.extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (has_word(client, "EGL_MESA_platform_surfaceless") && platform_display != nullptr)
    attempt({"surfaceless platform", -1, false, nullptr, ""},
            platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  return candidates;
}

std::unique_ptr<EglContext> EglContext::open(const std::string& device, bool debug) {
  const EglFunctions& egl = egl_functions();
  const char* client = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const std::vector<EglDevice> devices = egl_devices(egl, client);
  std::string reasons;
  const auto attempt = [&](EGLDisplay display) -> std::unique_ptr<EglContext> {
    try {
      return std::unique_ptr<EglContext>(new EglContext(egl, display, debug));
    } catch (const NotSupported& reason) {
      reasons += std::string(reasons.empty() ? "" : "; ") + reason.what();
      return nullptr;
    }
  };
  if (!device.empty()) {
    std::vector<std::unique_ptr<EglContext>> contexts;
    std::vector<std::string> names;
    for (const EglDevice& d : devices) {
      const std::size_t said = reasons.size();
      contexts.push_back(attempt(d.display));
      names.push_back(contexts.back() ? contexts.back()->gl().text(GL_RENDERER) : "unusable: " + reasons.substr(said));
    }
    const int chosen = choose_device("OpenGL", device, names);
    if (!contexts[std::size_t(chosen)])
      throw NotSupported("the OpenGL device " + device + " is " + names[std::size_t(chosen)]);
    return std::move(contexts[std::size_t(chosen)]);
  }
  for (const EglDevice& d : devices)
    if (!d.software)
      if (auto context = attempt(d.display)) return context;
  const auto platform_display = egl.extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (has_word(client, "EGL_MESA_platform_surfaceless") && platform_display != nullptr)
    if (auto context = attempt(platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)))
      return context;
  for (const EglDevice& d : devices)
    if (d.software)
      if (auto context = attempt(d.display)) return context;
  throw NotSupported("no OpenGL context can be had without a display: " +
                     (reasons.empty()
                          ? "EGL has neither EGL_EXT_platform_device nor EGL_MESA_platform_surfaceless, or no "
                            "driver (Debian: libegl-mesa0, libgl1-mesa-dri)"
                          : reasons));
}

EglContext::EglContext(const EglFunctions& egl, EGLDisplay display, bool debug) : egl_(egl), display_(display) {
  if (display == EGL_NO_DISPLAY || !egl.Initialize(display, nullptr, nullptr)) throw NotSupported("EGL does not start");
  const char* extensions = egl.QueryString(display, EGL_EXTENSIONS);
  for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context", "EGL_KHR_create_context"})
    if (!has_word(extensions, needed)) throw NotSupported(std::string("the EGL display lacks ") + needed);
  if (!egl.BindAPI(EGL_OPENGL_API)) throw NotSupported("the EGL display has no desktop OpenGL");
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_CONTEXT_FLAGS_KHR,
                               debug ? EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR : 0,
                               EGL_NONE};
  context_ = egl.CreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (context_ == EGL_NO_CONTEXT) throw NotSupported("the driver has no OpenGL 4.5 core context");
  try {
    load();
  } catch (...) {
    egl.DestroyContext(display, context_);
    throw;
  }
}

void EglContext::load() {
  make_current();
  const std::string missing = gl_.load([&](const char* name) { return egl_.GetProcAddress(name); });
  if (!missing.empty()) throw NotSupported("the OpenGL driver lacks " + missing);
  if (!gl_.has_extension("GL_ARB_gl_spirv"))
    throw NotSupported("the OpenGL driver " + gl_.text(GL_RENDERER) + " lacks GL_ARB_gl_spirv");
}

EglContext::~EglContext() {
  if (egl_.GetCurrentContext() == context_) egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  egl_.DestroyContext(display_, context_);
}

void EglContext::make_current() const {
  if (!egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
    throw NotSupported("the OpenGL context cannot be made current without a surface");
}

}  // namespace dvrlab
