// What the current OpenGL context can bind.
#pragma once

#include <cstdint>

#include "backends/opengl/gl_functions.h"
#include "framework/shader/shader.h"

namespace dvrlab {

std::int64_t gl_limit(const GlFunctions& gl, GLenum name);

ShaderLimits shader_limits(const GlFunctions& gl);

}  // namespace dvrlab
