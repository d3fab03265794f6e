#include "backends/opengl/limits.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace dvrlab {

std::int64_t gl_limit(const GlFunctions& gl, GLenum name) {
  GLint64 value = 0;
  gl.GetInteger64v(name, &value);
  return value;
}

bool is_software(std::string renderer) {
  std::transform(renderer.begin(), renderer.end(), renderer.begin(), [](unsigned char c) { return std::tolower(c); });
  return renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe") || renderer.starts_with("swrast");
}

ShaderLimits shader_limits(const GlFunctions& gl) {
  ShaderLimits limits;
  limits.target = ShaderTarget::opengl;
  limits.buffer_range = std::uint64_t(gl_limit(gl, GL_MAX_SHADER_STORAGE_BLOCK_SIZE));
  limits.runs_both_branches = is_software(gl.text(GL_RENDERER));
  limits.uniform_range = std::uint64_t(gl_limit(gl, GL_MAX_UNIFORM_BLOCK_SIZE));
  limits.storage_buffers = int(std::min(gl_limit(gl, GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS),
                                        gl_limit(gl, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS)));
  return limits;
}

}  // namespace dvrlab
