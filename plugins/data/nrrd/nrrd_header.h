// A NRRD file as a GridFile: what its header says about a 3-D scalar volume.
#pragma once

#include <string>

#include "framework/scene/grid_file.h"

namespace dvrlab::nrrd {

/// Reads the header of `name` and opens the data files that it names.
/// Throws InputError for a bad header and for what is no 3-D scalar volume, NotSupported for an encoding that is not
/// read.
GridFile open_nrrd(const std::string& name);

}  // namespace dvrlab::nrrd
