// Headers that name the files of their voxels: one file, a list, or a pattern with numbers.
#pragma once

#include <string>
#include <vector>

#include "framework/scene/grid_file.h"

namespace dvrlab {

struct DataFiles {
  std::vector<std::string> names;  // as written, relative to the header's folder
  long long axes = 3;              // how many axes of the grid one file spans; 3: whole slabs
};

/// The names that a pattern such as "slice%03d.raw" gives for first, first + step, ... up to last.
/// Throws InputError, `where` in front, unless there is exactly one "%d" with an optional width, for a step of 0, and
/// for more than `most` names.
std::vector<std::string> numbered_names(const std::string& pattern, long long first, long long last, long long step,
                                        long long most, const std::string& where);

/// Opens them. Throws InputError, `header_file` in front, when their number does not fit the grid or one is missing.
std::vector<FilePart> open_data_files(const DataFiles& files, const std::array<long long, 3>& dims,
                                      const std::string& header_file);

}  // namespace dvrlab
