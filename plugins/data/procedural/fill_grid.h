// A formula on a grid of stated size and type.
#pragma once

#include "framework/interfaces/field.h"
#include "plugins/data/procedural/make_formula.h"

namespace dvrlab::procedural {

struct GridPlan {
  std::array<int, 3> dims;
  VoxelType type;
  Box bounds;
  bool cell_centres;            // grid points in the middle of dims cells that fill the bounds; else bound to bound
  std::array<double, 2> range;  // integer types: the values of the smallest and the largest stored number
};

/// Evaluates the formula in fp64 at every grid point, on all processors, and rounds to nearest once. Values outside
/// `range` are clamped, with a note. to_world, slope, intercept, voxels, notes are set; finish_grid does the rest.
GridField fill_grid(const FormulaParams& f, const GridPlan& plan);

}  // namespace dvrlab::procedural
