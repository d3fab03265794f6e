// A mesh on a regular grid, for what asks a field at positions: light volumes.
#pragma once

#include <array>
#include <vector>

#include "framework/interfaces/mesh.h"

namespace dvrlab {

/// Values at the points of a grid over the mesh's box, x fastest.
struct ResampledMesh {
  std::array<int, 3> dims;
  std::vector<float> value;   // stored; 0 outside
  std::vector<float> inside;  // 1 where a cell holds the point, else 0
};

/// The field of the cell that holds each grid point, found by Newton's method in its reference coordinates where it is
/// not linear (residual 1e-10 of the cell); points on a face take one of its cells.
ResampledMesh resample(const MeshField& mesh, const std::array<int, 3>& dims);

}  // namespace dvrlab
