// Buffers -> storage buffers in pages, and the fetch primitives that read them.
#pragma once

#include <string>

#include "framework/shader/shader.h"

namespace dvrlab {

/// Splits a buffer into pages of at most `range` bytes, the first one bound at `binding`.
PagedBuffer page_buffer(const Buffer& buffer, std::uint64_t range, int binding);

/// GLSL of the pages and of
///   vec4:            vec4 fetch4_<name>(int i)
///   scalars:         float fetch1_<name>(uint i), void fetch2_<name>(uint i, out float a, out float b): i and i+1
///   integer scalars: int fetchi_<name>(int i)
std::string buffer_text(const PagedBuffer& paged);

}  // namespace dvrlab
