// The headers of one series, read where the library can do no harm.
#pragma once

#include <string>
#include <vector>

#include "plugins/data/dicom/image_header.h"

namespace dvrlab::dicom {

struct SeriesHeaders {
  std::vector<ImageHeader> image;  // of the files, by name
  std::vector<std::string> notes;
};

/// find_series() and the header of each of its files, read in a child process. Throws what these throw.
SeriesHeaders read_series_headers(const std::string& path, const std::string& wanted, const std::string& series_key);

}  // namespace dvrlab::dicom
