// What `dvrlab doctor` says of OpenGL.
#pragma once

#include "framework/interfaces/backend.h"

namespace dvrlab {

/// Every EGL device and the surfaceless platform, each with a context of its own for the time of the report. Never
/// throws: what is missing is the report's `problem`.
BackendReport opengl_report();

}  // namespace dvrlab
