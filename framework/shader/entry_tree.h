// A bounding volume hierarchy in storage buffers: which faces of a surface a ray may enter, for GPUs (kernel_unit.h,
// EntrySurface). The kernel's text judges the faces, so only the order of the visits is decided here.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/interfaces/kernel_unit.h"

namespace dvrlab {

/// Buffers of a surface `s`: s_box (two per node: lower and upper corner, a little outside of the faces) and s_node
/// (skip: the node after all below this one; first, count: its faces in the list behind the nodes, count 0 but for
/// leaves; the entry at which that list begins). Nodes are in the order of a depth-first visit. Built at the first use
/// and kept as long as the surface's faces are. Thread-safe.
std::shared_ptr<const std::vector<Buffer>> entry_tree_of(const EntrySurface& surface);

/// GLSL: what a sampler's text needs to be declared in front of it, and what has to follow it.
std::string entry_declaration(const EntrySurface& surface);
std::string entry_definition(const EntrySurface& surface);

}  // namespace dvrlab
