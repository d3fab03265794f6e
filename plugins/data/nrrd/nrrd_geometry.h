// Which axes of a NRRD file make the volume, and where it lies in the world.
#pragma once

#include <vector>

#include "framework/scene/grid_file.h"
#include "plugins/data/nrrd/nrrd_text.h"

namespace dvrlab::nrrd {

/// The number of axes that the header declares, and the three that are kept: axes of size 1 beyond three are dropped.
struct Axes {
  std::size_t declared = 3;
  std::vector<std::size_t> kept;
};

/// Sets dims and notes. Throws InputError for anything but three axes in space with one number each.
Axes read_axes(const NrrdText& text, GridFile& file);

/// Sets to_world, anatomical, length_unit and notes.
void read_geometry(const NrrdText& text, const Axes& axes, GridFile& file);

}  // namespace dvrlab::nrrd
