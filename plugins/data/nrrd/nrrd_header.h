// What a NRRD header says about a 3-D scalar volume.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "framework/interfaces/field.h"
#include "framework/scene/voxels.h"

namespace dvrlab::nrrd {

struct NrrdHeader {
  SourceType type = SourceType::u8;
  std::array<long long, 3> dims{};
  bool gzip = false;            // encoding: gzip or raw
  bool swap = false;            // the other byte order
  bool anatomical = false;      // the file names an anatomical space
  Affine to_world;              // voxel index -> world, RAS where the file names an anatomical space
  std::string data_file;        // detached: name as written; "" when the voxels follow the header
  std::size_t header_size = 0;  // attached: where the voxels start, before the skips
  long long line_skip = 0;      // lines to drop, before decompression
  long long byte_skip = 0;      // bytes to drop, after decompression; -1: the voxels are the file's end (raw only)
  std::vector<std::string> notes;
};

/// Throws InputError for a bad header and for what is no 3-D scalar volume, NotSupported for an encoding or a layout
/// of files that is not read. `name` is the file, for messages.
NrrdHeader read_header(std::span<const std::byte> file, const std::string& name);

}  // namespace dvrlab::nrrd
