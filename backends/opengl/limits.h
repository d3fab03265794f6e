// What the current OpenGL context can bind.
#pragma once

#include <cstdint>
#include <string>

#include "backends/opengl/gl_functions.h"
#include "framework/shader/shader.h"

namespace dvrlab {

std::int64_t gl_limit(const GlFunctions& gl, GLenum name);

/// The surfaceless platform does not say whether its renderer is a processor; Mesa's names do.
bool is_software(std::string renderer);

ShaderLimits shader_limits(const GlFunctions& gl);

}  // namespace dvrlab
