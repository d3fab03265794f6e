// What the XML of a VTK ImageData file says: the grid, its pieces, and where the bytes of each array lie.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/interfaces/field.h"
#include "framework/vtk_xml/array_values.h"
#include "framework/vtk_xml/vtk_xml.h"

namespace dvrlab::vti {

using vtk_xml::DataArray;
using vtk_xml::read_values;
using vtk_xml::read_values_bytes;
using vtk_xml::type_of;

/// First and last point index along x, y and z: x0 x1 y0 y1 z0 z1.
using Extent = std::array<long long, 6>;
/// Points along each axis; 0 or less where the extent is empty.
std::array<long long, 3> dims_of(const Extent& extent);

struct Piece {
  Extent extent{};
  std::string scalars;  // name of the active array, "" when none is named
  std::vector<DataArray> arrays;
  int cell_arrays = 0;
};

struct VtiHeader : vtk_xml::XmlFile {
  Extent whole{};
  Affine to_world;  // index of the first point of `whole` = (0, 0, 0) -> world
  std::vector<Piece> pieces;
};

/// Throws InputError for a bad file, NotSupported for a compressor that is not read. `name` is the file, for messages.
VtiHeader read_header(std::span<const std::byte> file, const std::string& name);

}  // namespace dvrlab::vti
