// What the header of one DICOM file says about its slices.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/interfaces/parameter_set.h"

namespace dvrlab::dicom {

/// One plane of pixels. Lengths in mm, patient coordinates LPS as in the file.
struct Slice {
  std::string file;
  int frame = 0;                        // within the file
  Vector3 position{};                   // centre of the first pixel
  Vector3 along_row{}, along_column{};  // unit vectors: towards the next column, the next row
  double column_spacing = 1, row_spacing = 1;
  double slope = 1, intercept = 0;
};

/// How the pixels of a file are stored.
struct PixelFormat {
  int columns = 0, rows = 0;
  int allocated = 16, stored = 16;  // bits of a pixel's place, and of its value
  bool is_signed = false;
  bool inverted = false;    // MONOCHROME1: shown with white for the lowest value
  std::string compression;  // UID of a compressed transfer syntax, "" for plain pixels
  std::uint64_t plane_bytes() const {
    return std::uint64_t(columns) * std::uint64_t(rows) * std::uint64_t(allocated / 8);
  }
};

struct ImageHeader {
  std::string file, series, description, modality;
  std::uint64_t file_bytes = 0;
  PixelFormat format;
  std::vector<Slice> slice;  // one per frame
};

/// nullopt for a DICOM file without an image (a report, a directory).
/// Throws InputError for a damaged file and for an image that is no grey slice with a place in space.
std::optional<ImageHeader> read_header(const std::string& file);

/// Which series a file belongs to, and how many slices of it the file holds.
struct SeriesKey {
  std::string uid, description, modality;
  int frames = 1;
};
/// nullopt for a DICOM file without an image. Throws InputError for a damaged file.
std::optional<SeriesKey> read_series(const std::string& file);

}  // namespace dvrlab::dicom
