// Backend "opengl": the march as one compute shader. See opengl.md.
#include "backends/opengl/device.h"
#include "backends/opengl/report.h"
#include "framework/shader/gpu_session.h"

namespace dvrlab {
namespace {

constexpr Parameter parameters[] = {
    {"device", ParameterType::text, "", "\"\"", "",
     "Index of the EGL device or a part of its renderer's name; empty: the first that is no software renderer, else "
     "one.",
     Affects::speed},
    {"band_ms", ParameterType::number, "ms", "100", "(0,inf)",
     "Time that one dispatch should take; rows are split into bands to stay below it.", Affects::speed, "", "1"},
    {"debug", ParameterType::boolean, "", "false", "",
     "Asks for a debug context; an error, undefined behaviour or message of high severity is an error.", Affects::speed,
     "", "true"},
};

class OpenGl final : public BackendPlugin {
 public:
  BackendReport report() const override { return opengl_report(); }
  std::unique_ptr<BackendSession> open(const ParameterSet& p, const std::string&) const override {
    return std::make_unique<GpuSession>(std::make_unique<GlDevice>(p.text("device"), p.boolean("debug")),
                                        p.number("band_ms") * 1e-3);
  }
};

}  // namespace
}  // namespace dvrlab

DVRLAB_PLUGIN("backend", "opengl", "1.0.0", dvrlab::OpenGl, dvrlab::parameters,
              "Runs the march as an OpenGL 4.5 compute shader through GL_ARB_gl_spirv, without a display.", "")
