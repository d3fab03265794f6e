// The kinds of starter configs, one for each kind of data.
#pragma once

#include <string>

#include "framework/app/data_input.h"
#include "framework/interfaces/mesh.h"

namespace dvrlab {

/// Opacity from a histogram of voxels, lit. Throws InputError when all voxels have one value.
std::string grid_starter_config(const LoadedData& data, const GridField& grid, const std::string& folder);
std::string grid_starter_words(const GridField& grid);

/// A volume density that is thin around the middle of the values and dense at both ends, which have colours of their
/// own. Throws InputError when all points have one value.
std::string mesh_starter_config(const LoadedData& data, const MeshField& mesh, const std::string& folder);
std::string mesh_starter_words(const MeshField& mesh);

}  // namespace dvrlab
