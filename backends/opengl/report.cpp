#include "backends/opengl/report.h"

#include "backends/opengl/egl_context.h"
#include "backends/opengl/limits.h"
#include "framework/interfaces/error.h"
#include "framework/report/byte_text.h"

namespace dvrlab {
namespace {

DeviceReport device_report(const EglCandidate& candidate) {
  DeviceReport r;
  r.software = candidate.software;
  r.property.emplace_back("opened through", candidate.way);
  if (candidate.index >= 0) r.property.emplace_back("index", std::to_string(candidate.index));
  if (candidate.context == nullptr) {
    r.name = candidate.way;
    r.property.emplace_back("unusable", candidate.reason);
    return r;
  }
  candidate.context->make_current();
  const GlFunctions& gl = candidate.context->gl();
  r.name = gl.text(GL_RENDERER);
  r.driver = gl.text(GL_VENDOR) + " " + gl.text(GL_VERSION);
  r.api = "OpenGL " + std::to_string(gl_limit(gl, GL_MAJOR_VERSION)) + "." +
          std::to_string(gl_limit(gl, GL_MINOR_VERSION)) + " core, GL_ARB_gl_spirv";
  r.software = r.software || is_software(r.name);
  const ShaderLimits limits = shader_limits(gl);
  r.property.insert(
      r.property.end(),
      {{"storage buffer", byte_text(limits.buffer_range)},
       {"storage buffers at once", std::to_string(limits.storage_buffers)},
       {"uniform block", byte_text(limits.uniform_range)},
       {"workgroup", std::to_string(gl_limit(gl, GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS)) + " invocations"},
       {"memory", "OpenGL does not tell"}});
  return r;
}

}  // namespace

BackendReport opengl_report() {
  BackendReport report;
  try {
    report.package = "libegl1";
    open_egl();
    report.package = "libegl-mesa0";
    const std::vector<EglCandidate> candidates = EglContext::all();
    std::string reasons;
    bool usable = false;
    for (const EglCandidate& c : candidates) {
      report.device.push_back(device_report(c));
      usable = usable || c.context != nullptr;
      if (!c.reason.empty()) reasons += (reasons.empty() ? "" : "; ") + c.way + ": " + c.reason;
    }
    if (candidates.empty()) {
      report.problem = "EGL has no driver that works without a display";
    } else if (usable) {
      report.package = "";
    } else {
      report.problem = "no OpenGL context can be had without a display: " + reasons;
      report.package = "libgl1-mesa-dri";
    }
  } catch (const NotSupported& e) {
    report.problem = e.what();
  }
  return report;
}

}  // namespace dvrlab
