// What the XML of a VTK ImageData file says: the grid, its pieces, and where the bytes of each array lie.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/interfaces/field.h"

namespace dvrlab::vti {

/// First and last point index along x, y and z: x0 x1 y0 y1 z0 z1.
using Extent = std::array<long long, 6>;
/// Points along each axis; 0 or less where the extent is empty.
std::array<long long, 3> dims_of(const Extent& extent);

enum class Format { ascii, inline_base64, appended };
enum class Compression { none, zlib, lz4, lzma };

/// A <DataArray> of point data.
struct DataArray {
  std::string name, type;  // type: "Float32"
  std::size_t line = 0;
  long long components = 1;
  Format format = Format::ascii;
  std::span<const std::byte> text;  // ascii, inline_base64: what stands between the tags
  std::uint64_t offset = 0;         // appended: from the byte behind the section's "_"
};

struct Piece {
  Extent extent{};
  std::string scalars;  // name of the active array, "" when none is named
  std::vector<DataArray> arrays;
  int cell_arrays = 0;
};

struct VtiHeader {
  Extent whole{};
  Affine to_world;  // index of the first point of `whole` = (0, 0, 0) -> world
  bool swap = false;
  int word = 4;  // bytes of a number in the headers of binary data: 4 or 8
  Compression compression = Compression::none;
  std::vector<Piece> pieces;
  std::span<const std::byte> appended;  // behind the "_"; base64: up to the end tag
  bool appended_base64 = false;
};

/// Throws InputError for a bad file, NotSupported for a compressor that is not read. `name` is the file, for messages.
VtiHeader read_header(std::span<const std::byte> file, const std::string& name);

}  // namespace dvrlab::vti
