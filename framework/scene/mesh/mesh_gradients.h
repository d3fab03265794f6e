// Gradients of a mesh's field, for normals.
#pragma once

#include <vector>

#include "framework/interfaces/mesh.h"

namespace dvrlab {

/// Of each cell at its centre: physical value per world length.
std::vector<Vector3> cell_gradients(const MeshField& mesh);

/// Of each point: the mean of cell_gradients of the cells that have it as a corner, plain or weighted with the inverse
/// distance of the cell's centre (`inverse_distance`).
std::vector<Vector3> vertex_gradients(const MeshField& mesh, bool inverse_distance);

}  // namespace dvrlab
