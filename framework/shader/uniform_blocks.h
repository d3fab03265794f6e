// Uniforms -> std140 blocks and constants.
#pragma once

#include <string>
#include <vector>

#include "framework/shader/shader.h"

namespace dvrlab {

/// The std140 block of the uniforms that are not constant; without members when there are none.
/// Throws NotSupported when it exceeds `uniform_range` bytes.
UniformBlock layout_block(const std::string& name, const std::vector<Uniform>& uniforms, std::uint64_t uniform_range);

/// GLSL of a block (at `block.binding`) and of the constants among `uniforms`.
std::string block_text(const UniformBlock& block, const std::vector<Uniform>& uniforms);

}  // namespace dvrlab
