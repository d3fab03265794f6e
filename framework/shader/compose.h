// FrameJob or StageJob -> GLSL.
#pragma once

#include "framework/interfaces/backend.h"
#include "framework/shader/shader.h"

namespace dvrlab {

/// The whole compute shader of a frame: framework texts, the sampler's and the estimator's kernel, and what is
/// generated from their uniforms and buffers. Throws NotSupported when the buffers do not fit the limits (with the
/// bytes), std::logic_error when two units use one name, std::runtime_error when a text cannot be read.
ComposedShader compose_shader(const FrameJob& job, const ShaderLimits& limits);

/// The shader of one stage of a light volume, likewise. Its output is `stage_channels` rows of the volume's width per
/// row.
ComposedShader compose_stage(const StageJob& job, const ShaderLimits& limits);

}  // namespace dvrlab
