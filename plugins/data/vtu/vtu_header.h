// What the XML of a VTK UnstructuredGrid file says.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/vtk_xml/vtk_xml.h"

namespace dvrlab::vtu {

struct Piece {
  std::uint64_t points = 0, cells = 0;
  std::string point_scalars, cell_scalars;  // names of the active arrays, "" when none is named
  std::vector<vtk_xml::DataArray> places, topology, point_data, cell_data;
};

struct VtuHeader : vtk_xml::XmlFile {
  std::vector<Piece> pieces;
};

/// Throws InputError for a bad file, NotSupported for a compressor that is not read. `name` is the file, for messages.
VtuHeader read_header(std::span<const std::byte> file, const std::string& name);

}  // namespace dvrlab::vtu
