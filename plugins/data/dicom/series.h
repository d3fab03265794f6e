// Which files of a folder are the series that a config asks for.
#pragma once

#include <string>
#include <vector>

namespace dvrlab::dicom {

struct SeriesFiles {
  std::vector<std::string> file;  // by name
  std::vector<std::string> notes;
};

/// `path`: a folder, whose files are looked at but not its subfolders, or one file, whose series is taken from its
/// folder. `wanted`: the SeriesInstanceUID or its beginning; "" for the only one.
/// Throws InputError, `series_key` in front where it is at fault, when the folder holds no image, when no series or
/// several fit (and lists them), and for a damaged DICOM file.
SeriesFiles find_series(const std::string& path, const std::string& wanted, const std::string& series_key);

/// True when a file of the folder begins like a DICOM file. Never throws.
bool holds_dicom(const std::string& folder) noexcept;

}  // namespace dvrlab::dicom
