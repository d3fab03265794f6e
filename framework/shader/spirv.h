// What dvrlab reads from a SPIR-V module and adds to it.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/shader/shader.h"

namespace dvrlab {

using Spirv = std::vector<std::uint32_t>;

/// Decorates every floating-point arithmetic instruction NoContraction, each exactly once. The `precise` qualifier
/// would miss arithmetic inside conditions and casts.
void add_no_contraction(Spirv& module);

/// Asks for float modes of 32-bit arithmetic: capability, extension and execution mode of each.
void add_float_modes(Spirv& module, const std::vector<FloatMode>& modes);

/// Throws std::runtime_error naming the first instruction whose result may differ between devices: division,
/// matrix and dot products, and every extended instruction that is not exact (exp, sqrt, mix, ...).
void check_strict(const Spirv& module);

/// Throws std::logic_error when a block's member lies elsewhere than `block` says.
void check_offsets(const Spirv& module, const UniformBlock& block);

}  // namespace dvrlab
