// GLSL -> SPIR-V, through the disk cache.
#pragma once

#include "framework/shader/shader.h"
#include "framework/shader/spirv.h"

namespace dvrlab {

/// Where a module came from, for tests and for the log.
struct CompiledShader {
  Spirv spirv;
  std::string hash;  // SHA-256 of the text, the options and the compiler: the cache's key
  bool from_cache = false;
};

/// The cache's key of a shader: equal keys, equal SPIR-V.
std::string shader_hash(const ComposedShader& shader);

/// SPIR-V 1.3 for Vulkan 1.1, or 1.0 for GL_ARB_gl_spirv. Strict shaders are
/// checked and decorated (spirv.h). Throws std::runtime_error with the compiler's messages, file names and lines of the
/// kernel texts.
CompiledShader compile_shader(const ComposedShader& shader);

}  // namespace dvrlab
