// The slices of a series as one grid: their order, their distances, the affine.
#pragma once

#include <string>
#include <vector>

#include "framework/interfaces/field.h"
#include "plugins/data/dicom/image_header.h"

namespace dvrlab::dicom {

struct Stack {
  PixelFormat format;        // what all have in common: size, bits allocated, sign
  std::vector<Slice> slice;  // along the normal, row direction x column direction
  Affine to_world;           // column, row, slice -> world, RAS, mm
  std::vector<std::string> notes;
  bool one_scaling() const;  // slope and intercept are the same in every slice
};

/// Throws InputError, naming the files, when sizes, types, orientations or spacings differ, when slices are missing,
/// doubled or unevenly spaced, or when there is only one.
Stack make_stack(const std::vector<ImageHeader>& images);

}  // namespace dvrlab::dicom
