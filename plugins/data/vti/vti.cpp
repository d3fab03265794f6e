// The VTK ImageData reader: .vti, one array of its point data.
#include <algorithm>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/sha256.h"
#include "framework/vtk_xml/array_values.h"
#include "plugins/data/vti/pieces.h"

namespace dvrlab::vti {
namespace {

constexpr Parameter parameters[] = {
    {"file", ParameterType::text, "", nullptr, "",
     "The .vti file, relative to the config's folder; ${NAME} reads the environment.", Affects::pixels, "{}",
     R"("../../../data/torus.vti")"},
    {"array", ParameterType::text, "", R"("")", "",
     "Name of the array of point data; \"\": the one that the file names as active scalars, else the only one.",
     Affects::pixels, "{}", R"("distance")"},
    {"component", ParameterType::integer, "", "-1", "[-1,inf)",
     "Component of a vector array, from 0; -1: the array has one component.", Affects::pixels,
     R"({"data":{"array":"gradient","component":0}})", "2"}};

struct Opened {
  std::string name;
  std::shared_ptr<const MappedFile> file;
  VtiHeader header;
  Parts parts;
};

Opened open(const ParameterSet& p, const LoadContext& context) {
  Opened o;
  o.name = resolve_path(p.text("file"), context, p.path_of("file"));
  o.file = MappedFile::open(o.name);
  o.header = read_header(o.file->bytes(), o.name);
  o.parts = choose_parts(o.header,
                         {p.text("array"), p.integer("component"), p.path_of("array"), p.path_of("component")}, o.name);
  return o;
}

std::uint64_t whole_bytes(const Opened& o) {
  return grid_bytes(dims_of(o.header.whole), bytes_of(o.parts.type), o.name + ": WholeExtent");
}

// The file's own bytes where they are the volume, else a copy in this machine's byte order.
SourceVoxels volume_of(const Opened& o) {
  const auto values = [&](const Part& part) {
    return read_values(o.header, part.array, part.numbers, o.file, part.where);
  };
  if (o.parts.direct()) return values(o.parts.part.front());
  std::shared_ptr<void> volume;
  for (const Part& part : o.parts.part) {
    const SourceVoxels v = values(part);  // before the volume is allocated: a file that is cut off takes no memory
    if (!volume) volume = allocate_voxels(whole_bytes(o), o.name);
    place_part(part, v, o.parts.component, o.header.whole, static_cast<std::byte*>(volume.get()));
  }
  return {o.parts.type, false, volume};
}

class Vti : public DataPlugin {
 public:
  bool recognises(const std::string& path, std::span<const std::byte> start) const override {
    return vtk_xml::is_file_of("ImageData", ".vti", path, start);
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const auto grid = std::make_shared<GridField>();
    const auto dims = dims_of(o.header.whole);
    for (std::size_t a = 0; a < 3; ++a) grid->dims[a] = static_cast<int>(dims[a]);
    grid->to_world = o.header.to_world;
    grid->source = o.name;
    grid->sha256 = sha256({o.file->bytes()});
    grid->notes = notes_of(o);
    set_voxels(*grid, volume_of(o), o.name);
    finish_grid(*grid, context.nan_policy, context.nan_value);
    return grid;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const std::uint64_t whole = whole_bytes(o), count = whole / bytes_of(o.parts.type);
    std::uint64_t largest = 0;
    for (const Part& part : o.parts.part)
      largest = std::max(largest, read_values_bytes(o.header, part.array, part.numbers, o.file->bytes().size()));
    if (!o.parts.direct()) return largest + whole + set_voxels_bytes(o.parts.type, false, count);
    // Values in the file itself are copied also when they do not lie at a multiple of their size.
    const bool copied = largest == 0 && bytes_of(o.parts.type) > 1;
    return largest + set_voxels_bytes(o.parts.type, o.header.swap || copied, count);
  }

 private:
  static std::vector<std::string> notes_of(const Opened& o) {
    std::vector<std::string> notes{"world frame: the file's own coordinates; the format names no anatomical space"};
    const DataArray& array = o.parts.part.front().array;
    std::size_t arrays = o.header.pieces.front().arrays.size();
    if (arrays > 1) notes.push_back("array \"" + array.name + "\" of " + std::to_string(arrays) + " is read");
    if (array.components > 1)
      notes.push_back("component " + std::to_string(o.parts.component) + " of " + std::to_string(array.components) +
                      " is read");
    if (o.parts.part.size() > 1) notes.push_back(std::to_string(o.parts.part.size()) + " pieces were put together");
    return notes;
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "vti", "1.0.0", Vti, parameters,
              "Reads an array of point data from a VTK ImageData file, .vti: ascii, base64 or raw, compressed or not.",
              "VTK XML file formats, https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html")

}  // namespace dvrlab::vti
