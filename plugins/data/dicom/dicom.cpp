// The DICOM reader: the slices of one series as a volume. GDCM reads the files and decodes the pixels.
#include <gdcmTrace.h>

#include <algorithm>
#include <filesystem>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/sha256.h"
#include "framework/scene/voxels.h"
#include "plugins/data/dicom/element_lengths.h"
#include "plugins/data/dicom/pixels.h"
#include "plugins/data/dicom/series.h"
#include "plugins/data/dicom/series_headers.h"
#include "plugins/data/dicom/stack.h"

namespace dvrlab::dicom {
namespace {

constexpr Parameter parameters[] = {
    {"file", ParameterType::text, "", nullptr, "",
     "The folder with the series, or one of its files, relative to the config's folder; ${NAME} reads the environment.",
     Affects::pixels, "{}", R"("../../../data/dicom_torus/sagittal_03.dcm")"},
    {"series", ParameterType::text, "", R"("")", "",
     "SeriesInstanceUID of the series, or its beginning; \"\": the only one of the folder, or the file's own.",
     Affects::pixels, R"({"data":{"file":"../../../data/dicom_torus","series":"2.25.1"}})", R"("2.25.2")"}};

struct Opened {
  std::string name;
  std::vector<ImageHeader> images;
  Stack stack;
  std::array<long long, 3> dims;
};

Opened open(const ParameterSet& p, const LoadContext& context) {
  Opened o;
  o.name = resolve_path(p.text("file"), context, p.path_of("file"));
  SeriesHeaders series = read_series_headers(o.name, p.text("series"), p.path_of("series"));
  o.images = std::move(series.image);
  o.stack = make_stack(o.images);
  o.stack.notes.insert(o.stack.notes.begin(), series.notes.begin(), series.notes.end());
  o.dims = {o.stack.format.columns, o.stack.format.rows, static_cast<long long>(o.stack.slice.size())};
  grid_bytes(o.dims, sizeof(float), o.name);
  return o;
}

std::vector<std::string> notes_of(const Opened& o) {
  std::vector<std::string> notes = o.stack.notes;
  notes.push_back("world frame: RAS, the patient's LPS coordinates with x and y negated, in mm");
  if (const auto compressed =
          std::find_if(o.images.begin(), o.images.end(), [](const auto& h) { return !h.format.compression.empty(); });
      compressed != o.images.end())
    notes.push_back("the pixels were decompressed by GDCM, transfer syntax " + compressed->format.compression);
  if (o.stack.format.inverted)
    notes.push_back(
        "MONOCHROME1: the values are kept; the convention to show low ones white is the transfer function's");
  return notes;
}

// Of the slices' digests in the order of the volume: a series has too many files to be hashed as one.
std::string fingerprint(const Stack& stack) {
  std::string digests, last;
  for (const Slice& s : stack.slice) {
    if (s.file != last) digests += sha256({MappedFile::open(s.file)->bytes()});
    last = s.file;
  }
  return sha256({std::as_bytes(std::span(digests))});
}

class Dicom : public DataPlugin {
 public:
  Dicom() {  // the library's own messages would go to stderr
    gdcm::Trace::DebugOff();
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
  }

  bool recognises(const std::string& path, std::span<const std::byte> start) const override {
    std::error_code error;
    return std::filesystem::is_directory(path, error) ? holds_dicom(path) : has_magic(start);
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const auto grid = std::make_shared<GridField>();
    for (std::size_t a = 0; a < 3; ++a) grid->dims[a] = static_cast<int>(o.dims[a]);
    grid->to_world = o.stack.to_world;
    grid->anatomical = true;
    grid->length_unit = "mm";
    grid->source = o.name;
    grid->notes = notes_of(o);
    set_pixels(*grid, o.stack, o.images);
    grid->sha256 = fingerprint(o.stack);
    finish_grid(*grid, context.nan_policy, context.nan_value);
    return grid;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    return set_pixels_bytes(o.stack, o.images);
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "dicom", "1.0.0", Dicom, parameters,
              "Reads the slices of a DICOM series as one volume, sorted by position, with rescaling and orientation.",
              "DICOM PS3.3, C.7.6.2 (image plane), C.11.1 (modality LUT); GDCM, https://gdcm.sourceforge.net")

}  // namespace dvrlab::dicom
