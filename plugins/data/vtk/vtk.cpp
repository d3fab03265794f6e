// The reader of legacy VTK files with an unstructured grid: .vtk, one array of its points or cells.
#include <algorithm>
#include <string_view>

#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh_keys.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/mesh/mesh_array.h"
#include "framework/scene/sha256.h"
#include "plugins/data/vtk/vtk_file.h"

namespace dvrlab::vtk {
namespace {

constexpr Parameter file_key{"file",
                             ParameterType::text,
                             "",
                             nullptr,
                             "",
                             "The .vtk file, relative to the config's folder; ${NAME} reads the environment.",
                             Affects::pixels,
                             R"({"data":{"array":"velocity","component":"norm"}})",
                             R"("../../../data/CylinderLinear.vtk")"};

constexpr Parameter parameters[] = {
    file_key, seen_in(mesh_array_key, "{}", R"("velocity_norm")"),
    seen_in(mesh_component_key, R"({"data":{"array":"velocity","component":"0"}})", R"("norm")"), mesh_normals_key,
    mesh_tolerance_key};

struct Opened {
  std::string name;
  std::shared_ptr<const MappedFile> file;
  VtkFile sections;
};

Opened open(const ParameterSet& p, const LoadContext& context) {
  Opened o;
  o.name = resolve_path(p.text("file"), context, p.path_of("file"));
  o.file = MappedFile::open(o.name);
  o.sections = read_sections(o.file->bytes(), o.name);
  return o;
}

void add_cells(const Opened& o, MeshField& mesh, std::vector<std::uint64_t>& kept) {
  const VtkFile& f = o.sections;
  const auto bytes = o.file->bytes();
  std::vector<std::int64_t> nodes = integers_of(f, bytes, f.connectivity), ends;
  if (f.counted) {
    std::vector<std::int64_t> list;
    list.reserve(nodes.size());
    std::size_t at = 0;
    for (std::uint64_t c = 0; c < f.cells; ++c) {
      const std::int64_t n = at < nodes.size() ? nodes[at] : -1;
      if (n < 0 || static_cast<std::size_t>(n) > nodes.size() - at - 1)
        throw InputError(f.connectivity.where + ": the list of nodes ends inside cell " + std::to_string(c));
      list.insert(list.end(), nodes.begin() + static_cast<std::ptrdiff_t>(at + 1),
                  nodes.begin() + static_cast<std::ptrdiff_t>(at + 1) + n);
      at += static_cast<std::size_t>(n) + 1;
      ends.push_back(static_cast<std::int64_t>(list.size()));
    }
    nodes = std::move(list);
  } else {
    ends = integers_of(f, bytes, f.offsets);
    if (!ends.empty()) ends.erase(ends.begin());
  }
  add_vtk_cells(mesh, integers_of(f, bytes, f.types), nodes, ends, 0, kept, o.name);
}

class Vtk : public DataPlugin {
 public:
  bool recognises(const std::string&, std::span<const std::byte> start) const override {
    const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
    return text.starts_with("# vtk DataFile Version") && text.find("UNSTRUCTURED_GRID") != std::string_view::npos;
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const VtkFile& f = o.sections;
    const auto mesh = std::make_shared<MeshField>();
    mesh->source = o.name;
    mesh->sha256 = sha256({o.file->bytes()});
    mesh->gradient = mesh_gradient(p);
    mesh->tolerance = p.number("tolerance");
    mesh->notes.push_back("world frame: the file's own coordinates");
    std::vector<MeshArray> arrays;
    for (const DataArray& a : f.arrays) arrays.push_back({a.name, a.components, a.cells, a.active});
    const MeshChoice choice = choose_mesh_array(arrays, p, o.name, mesh->notes);
    const MeshArray& chosen = arrays[choice.array];
    add_points(*mesh, doubles_of(f, o.file->bytes(), f.places));
    std::vector<std::uint64_t> kept;
    add_cells(o, *mesh, kept);
    const std::vector<double> values =
        scalars_of(doubles_of(f, o.file->bytes(), f.arrays[choice.array].numbers), chosen.components, choice.component);
    if (chosen.cells) {
      std::vector<double> of_cells;
      for (const std::uint64_t c : kept) of_cells.push_back(values[c]);
      set_cell_values(*mesh, of_cells);
    } else {
      mesh->value = values;
    }
    finish_mesh(*mesh, context.nan_policy, context.nan_value);
    return mesh;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const VtkFile& f = o.sections;
    std::uint64_t largest = 0;
    for (const DataArray& a : f.arrays) largest = std::max(largest, a.numbers.count);
    return f.points * (24 * 3 + 40) + f.cells * 64 + f.connectivity.count * 24 + largest * 16;
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "vtk", "1.0.0", Vtk, parameters,
              "Reads an array of an unstructured grid from a legacy VTK file, .vtk: ascii or binary.",
              "VTK legacy file formats, https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html")

}  // namespace dvrlab::vtk
