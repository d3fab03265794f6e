// The pixels of the slices as voxels.
#pragma once

#include <cstdint>

#include "framework/interfaces/field.h"
#include "plugins/data/dicom/stack.h"

namespace dvrlab::dicom {

/// Fills type, voxels, slope and intercept of a grid whose dims are set, with notes. The stored type is kept where
/// all slices share slope and intercept; else the values become physical ones in float32.
/// Throws InputError, naming the file, for pixels that are damaged, NotSupported for a compression that GDCM cannot
/// decode.
void set_pixels(GridField& grid, const Stack& stack, const std::vector<ImageHeader>& images);

/// Bytes that set_pixels allocates at the most.
std::uint64_t set_pixels_bytes(const Stack& stack, const std::vector<ImageHeader>& images);

}  // namespace dvrlab::dicom
