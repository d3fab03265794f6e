#include "plugins/data/dicom/image_header.h"

#include <gdcmReader.h>

#include <algorithm>
#include <cmath>

#include "framework/interfaces/error.h"
#include "framework/scene/child.h"
#include "framework/scene/mapped_file.h"
#include "plugins/data/dicom/element_lengths.h"
#include "plugins/data/dicom/elements.h"

namespace dvrlab::dicom {
namespace {

constexpr Key rows{0x0028, 0x0010, "Rows"}, columns{0x0028, 0x0011, "Columns"},
    bits_allocated{0x0028, 0x0100, "BitsAllocated"}, bits_stored{0x0028, 0x0101, "BitsStored"},
    high_bit{0x0028, 0x0102, "HighBit"}, pixel_representation{0x0028, 0x0103, "PixelRepresentation"},
    samples_per_pixel{0x0028, 0x0002, "SamplesPerPixel"}, photometric{0x0028, 0x0004, "PhotometricInterpretation"},
    number_of_frames{0x0028, 0x0008, "NumberOfFrames"}, series_uid{0x0020, 0x000e, "SeriesInstanceUID"},
    series_description{0x0008, 0x103e, "SeriesDescription"}, modality{0x0008, 0x0060, "Modality"},
    image_position{0x0020, 0x0032, "ImagePositionPatient"},
    image_orientation{0x0020, 0x0037, "ImageOrientationPatient"}, pixel_spacing{0x0028, 0x0030, "PixelSpacing"},
    rescale_slope{0x0028, 0x1053, "RescaleSlope"}, rescale_intercept{0x0028, 0x1052, "RescaleIntercept"},
    modality_lut{0x0028, 0x3000, "ModalityLUTSequence"},
    per_frame_groups{0x5200, 0x9230, "PerFrameFunctionalGroupsSequence"},
    shared_groups{0x5200, 0x9229, "SharedFunctionalGroupsSequence"},
    plane_position{0x0020, 0x9113, "PlanePositionSequence"},
    plane_orientation{0x0020, 0x9116, "PlaneOrientationSequence"},
    pixel_measures{0x0028, 0x9110, "PixelMeasuresSequence"},
    value_transformation{0x0028, 0x9145, "PixelValueTransformationSequence"};

struct Read {
  Elements elements;
  gdcm::TransferSyntax syntax;
  std::uint64_t file_bytes;
};

// Everything in front of the pixels.
Read read_elements(const std::string& file) {
  const auto mapped = MappedFile::open(file);
  if (!has_magic(mapped->bytes())) throw InputError(file + ": is no DICOM file; \"DICM\" does not stand at byte 128");
  check_lengths(mapped->bytes(), file);
  reading(file);
  gdcm::Reader reader;
  reader.SetFileName(file.c_str());
  bool good = false;
  try {
    good = reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x0010));
  } catch (const std::exception&) {
    good = false;
  }
  if (!good) throw InputError(file + ": GDCM cannot read the DICOM header; the file is cut off or damaged");
  const auto syntax = reader.GetFile().GetHeader().GetDataSetTransferSyntax();
  if (!syntax.IsValid()) throw NotSupported(file + ": GDCM does not know its transfer syntax; store it uncompressed");
  return {Elements(reader.GetFile().GetDataSet(), file), syntax, mapped->bytes().size()};
}

PixelFormat read_format(const Read& r) {
  const Elements& e = r.elements;
  PixelFormat f;
  f.columns = e.whole(columns);
  f.rows = e.whole(rows);
  if (f.columns < 2 || f.rows < 2)
    e.fail(f.columns < 2 ? columns : rows, "is " + std::to_string(std::min(f.columns, f.rows)) +
                                               "; a volume needs at least 2 grid points along each axis");
  const int samples = e.whole(samples_per_pixel, 1);
  const std::string color = e.text(photometric);
  if (samples != 1 || (color != "MONOCHROME1" && color != "MONOCHROME2"))
    e.fail(photometric, "is \"" + color + "\" with " + std::to_string(samples) +
                            " samples per pixel; only grey images (MONOCHROME1, MONOCHROME2) are read");
  f.inverted = color == "MONOCHROME1";
  f.allocated = e.whole(bits_allocated);
  f.stored = e.whole(bits_stored, f.allocated);
  if (f.allocated != 8 && f.allocated != 16)
    e.fail(bits_allocated, "is " + std::to_string(f.allocated) + "; pixels of 8 and 16 bits are read");
  if (f.stored < 1 || f.stored > f.allocated)
    e.fail(bits_stored,
           "is " + std::to_string(f.stored) + "; must lie between 1 and BitsAllocated, " + std::to_string(f.allocated));
  if (e.whole(high_bit, f.stored - 1) != f.stored - 1)
    e.fail(high_bit, "is " + std::to_string(e.whole(high_bit)) +
                         "; only the lowest bits, BitsStored - 1 = " + std::to_string(f.stored - 1) + ", are read");
  f.is_signed = e.whole(pixel_representation, 0) == 1;
  if (r.syntax.IsEncapsulated()) f.compression = r.syntax.GetString();
  return f;
}

Vector3 vector(const std::vector<double>& x, std::size_t first) { return {x[first], x[first + 1], x[first + 2]}; }

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The numbers of `key` where the standard keeps them: in the data set, or in the frame's own or the shared groups.
std::vector<double> place(const Elements& e, std::size_t frame, const Key& group, const Key& key, std::size_t count) {
  for (const auto& [groups, index] : {std::pair{per_frame_groups, frame}, {shared_groups, std::size_t{0}}})
    if (const auto functional = e.item(groups, index))
      if (const auto inner = functional->item(group, 0))
        if (auto x = inner->decimals(key, count); !x.empty()) return x;
  return e.decimals(key, count);
}

Slice read_slice(const Elements& e, int frame) {
  Slice s;
  s.file = e.name();
  s.frame = frame;
  const auto numbers = [&](const Key& group, const Key& key, std::size_t count) {
    auto x = place(e, static_cast<std::size_t>(frame), group, key, count);
    if (x.empty()) e.fail(key, "is missing; without it the slice has no place in space");
    return x;
  };
  s.position = vector(numbers(plane_position, image_position, 3), 0);
  const auto orientation = numbers(plane_orientation, image_orientation, 6);
  s.along_row = vector(orientation, 0);
  s.along_column = vector(orientation, 3);
  constexpr double rounding = 1e-3;  // files write six digits, some only four
  if (std::fabs(dot(s.along_row, s.along_row) - 1) > rounding ||
      std::fabs(dot(s.along_column, s.along_column) - 1) > rounding ||
      std::fabs(dot(s.along_row, s.along_column)) > rounding)
    e.fail(image_orientation, "does not hold two unit vectors at a right angle");
  const auto spacing = numbers(pixel_measures, pixel_spacing, 2);
  s.row_spacing = spacing[0];
  s.column_spacing = spacing[1];
  if (!(s.row_spacing > 0 && s.column_spacing > 0)) e.fail(pixel_spacing, "must hold two numbers above 0");
  const auto slope = place(e, static_cast<std::size_t>(frame), value_transformation, rescale_slope, 1);
  const auto intercept = place(e, static_cast<std::size_t>(frame), value_transformation, rescale_intercept, 1);
  if (slope.empty() && intercept.empty() && e.has(modality_lut))
    e.fail(modality_lut, "maps the values by a table; only RescaleSlope and RescaleIntercept are read");
  if (!slope.empty()) s.slope = slope[0];
  if (!intercept.empty()) s.intercept = intercept[0];
  if (s.slope == 0) e.fail(rescale_slope, "is 0: every value would be the same");
  return s;
}

int count_frames(const Elements& e) {
  if (!e.has(number_of_frames)) return 1;
  const double n = e.decimals(number_of_frames, 1)[0];
  if (!(n >= 1 && n <= 1e6 && n == std::floor(n))) e.fail(number_of_frames, "is no whole number of at least 1");
  return static_cast<int>(n);
}

}  // namespace

std::optional<SeriesKey> read_series(const std::string& file) {
  const Read r = read_elements(file);
  if (!r.elements.has(rows)) return std::nullopt;
  return SeriesKey{r.elements.text(series_uid), r.elements.text(series_description), r.elements.text(modality),
                   count_frames(r.elements)};
}

std::optional<ImageHeader> read_header(const std::string& file) {
  const Read r = read_elements(file);
  const Elements& e = r.elements;
  if (!e.has(rows)) return std::nullopt;
  ImageHeader h{file, e.text(series_uid), e.text(series_description), e.text(modality), r.file_bytes, {}, {}};
  h.format = read_format(r);
  const int frames = count_frames(e);
  if (frames > 1 && !e.item(per_frame_groups, 0))
    e.fail(number_of_frames,
           "is " + std::to_string(frames) + ", but the frames have no positions (PerFrameFunctionalGroupsSequence)");
  const std::uint64_t pixels = h.format.plane_bytes() * static_cast<std::uint64_t>(frames);
  if (h.format.compression.empty() && !r.syntax.IsEncoded() && pixels > h.file_bytes)
    throw InputError(file + ": its header announces " + std::to_string(pixels) + " bytes of pixels, the file has " +
                     std::to_string(h.file_bytes) + "; it is cut off or its header is wrong");
  for (int i = 0; i < frames; ++i) h.slice.push_back(read_slice(e, i));
  return h;
}

}  // namespace dvrlab::dicom
