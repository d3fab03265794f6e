#include "plugins/data/dicom/series_headers.h"

#include <nlohmann/json.hpp>

#include "framework/scene/child.h"
#include "plugins/data/dicom/series.h"

namespace dvrlab::dicom {

// How the headers come over from the child.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Slice, file, frame, position, along_row, along_column, column_spacing, row_spacing,
                                   slope, intercept)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PixelFormat, columns, rows, allocated, stored, is_signed, inverted, compression)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ImageHeader, file, series, description, modality, file_bytes, format, slice)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SeriesHeaders, image, notes)

SeriesHeaders read_series_headers(const std::string& path, const std::string& wanted, const std::string& series_key) {
  constexpr std::uint64_t memory = 256 << 20;  // headers are small; those of multi-frame files some megabytes
  const Bytes bytes = in_child("GDCM", memory, [&] {
    const SeriesFiles files = find_series(path, wanted, series_key);
    SeriesHeaders headers{{}, files.notes};
    for (const std::string& file : files.file) headers.image.push_back(read_header(file).value());
    return nlohmann::json::to_msgpack(headers);
  });
  return nlohmann::json::from_msgpack(bytes).get<SeriesHeaders>();
}

}  // namespace dvrlab::dicom
