// What a NIfTI header (version 1 or 2, either byte order) says about a 3-D scalar volume.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/interfaces/field.h"
#include "framework/scene/voxels.h"

namespace dvrlab::nifti {

struct NiftiHeader {
  SourceType type = SourceType::u8;
  std::array<long long, 3> dims{};
  bool swap = false;               // the other byte order
  std::uint64_t voxel_offset = 0;  // bytes from the start of the (decompressed) file
  double slope = 1, intercept = 0;
  Affine to_world;          // voxel index -> world, RAS, the file's unit of length
  bool anatomical = false;  // by sform or qform
  std::string length_unit;  // "mm", "m", "um", "" when the header does not say
  std::vector<std::string> notes;
};

/// The longest header, of version 2.
inline constexpr std::size_t header_size = 540;

/// True if `start`, which may end early, starts like a NIfTI header of either version and byte order, pairs included.
bool has_magic(std::span<const std::byte> start);

/// `file`: the first header_size bytes, or the whole file when it is shorter. Everything that decides memory is
/// checked here before nifticlib sees it. `name` is the file, for messages.
/// Throws InputError for a bad header and for what is no 3-D scalar volume, NotSupported for .hdr/.img pairs.
NiftiHeader read_header(std::span<const std::byte> file, const std::string& name);

}  // namespace dvrlab::nifti
