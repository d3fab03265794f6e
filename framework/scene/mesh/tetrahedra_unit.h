// A mesh's tetrahedra as kernels walk through them (framework/kernel/tetrahedra.kernel).
#pragma once

#include "framework/interfaces/kernel_unit.h"
#include "framework/interfaces/mesh.h"

namespace dvrlab {

/// Adds the buffers tetrahedra_cell, tetrahedra_vertex, tetrahedra_face and the surface tetrahedra_entry.
void add_tetrahedra(const MeshField& mesh, KernelUnit& unit);
/// Bytes of them, and of what the host keeps to make them.
std::uint64_t tetrahedra_bytes(const MeshField& mesh);

/// Gradients, stored value per world length: (x, y, z, 0) of each tetrahedron (MeshGradient::cell) or of each vertex.
std::vector<double> slope_rows(const MeshField& mesh);

/// World to sampler coordinates: a shift and one factor (finish_mesh).
Vector3 sampler_point(const MeshField& mesh, const Vector3& p);

}  // namespace dvrlab
