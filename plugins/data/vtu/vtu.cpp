// The VTK UnstructuredGrid reader: .vtu, one array of its points or cells.
#include <algorithm>

#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh_keys.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/mesh/mesh_array.h"
#include "framework/scene/sha256.h"
#include "framework/vtk_xml/array_values.h"
#include "plugins/data/vtu/vtu_header.h"

namespace dvrlab::vtu {
namespace {

using vtk_xml::DataArray;

constexpr Parameter file_key{"file",
                             ParameterType::text,
                             "",
                             nullptr,
                             "",
                             "The .vtu file, relative to the config's folder; ${NAME} reads the environment.",
                             Affects::pixels,
                             R"({"data":{"array":"","component":"norm"}})",
                             R"("../../../data/notch_disp.vtu")"};

constexpr Parameter parameters[] = {
    file_key, seen_in(mesh_array_key, "{}", R"("Pres")"),
    seen_in(mesh_component_key, R"({"data":{"array":"V","component":"0"}})", R"("norm")"), mesh_normals_key,
    mesh_tolerance_key};

struct Opened {
  std::string name;
  std::shared_ptr<const MappedFile> file;
  VtuHeader header;
};

Opened open(const ParameterSet& p, const LoadContext& context) {
  Opened o;
  o.name = resolve_path(p.text("file"), context, p.path_of("file"));
  o.file = MappedFile::open(o.name);
  o.header = read_header(o.file->bytes(), o.name);
  return o;
}

/// Reads arrays of one piece.
class PieceReader {
 public:
  PieceReader(const Opened& o, const Piece& piece) : o_(o), piece_(piece) {}

  std::string where(const DataArray& a) const {
    return o_.name + ": line " + std::to_string(a.line) + ": array \"" + a.name + "\"";
  }
  std::vector<double> doubles(const DataArray& a, std::uint64_t entries) const {
    const std::uint64_t count = counted(a, entries);
    return to_doubles(read_values(o_.header, a, count, o_.file, where(a)), count);
  }
  std::vector<std::int64_t> integers(const DataArray& a, std::uint64_t count) const {
    return to_integers(read_values(o_.header, a, count, o_.file, where(a)), count, where(a));
  }
  const DataArray& topology(const std::string& name) const {
    for (const DataArray& a : piece_.topology)
      if (a.name == name) return a;
    throw InputError(o_.name + ": <Cells> holds no array \"" + name + "\"");
  }
  const DataArray& places() const {
    if (piece_.places.size() != 1)
      throw InputError(o_.name + ": <Points> holds " + std::to_string(piece_.places.size()) + " arrays; it needs one");
    if (piece_.places.front().components != 3)
      throw InputError(where(piece_.places.front()) + ": has " + std::to_string(piece_.places.front().components) +
                       " components; a point has 3");
    return piece_.places.front();
  }

 private:
  std::uint64_t counted(const DataArray& a, std::uint64_t entries) const {
    std::uint64_t n = static_cast<std::uint64_t>(a.components);
    if (__builtin_mul_overflow(n, entries, &n) || n >> 59)
      throw InputError(where(a) + ": its points and its components overflow; no memory holds such an array");
    return n;
  }
  const Opened& o_;
  const Piece& piece_;
};

std::vector<MeshArray> arrays_of(const Piece& p) {
  std::vector<MeshArray> list;
  for (const DataArray& a : p.point_data)
    list.push_back({a.name, a.components, false, !p.point_scalars.empty() && a.name == p.point_scalars});
  for (const DataArray& a : p.cell_data)
    list.push_back({a.name, a.components, true, !p.cell_scalars.empty() && a.name == p.cell_scalars});
  return list;
}

const DataArray& array_of(const Piece& p, const MeshArray& chosen, const std::string& name) {
  for (const DataArray& a : chosen.cells ? p.cell_data : p.point_data)
    if (a.name == chosen.name && a.components == chosen.components) return a;
  throw InputError(name + ": another piece has no array \"" + chosen.name + "\" of " +
                   std::to_string(chosen.components) + " components");
}

class Vtu : public DataPlugin {
 public:
  bool recognises(const std::string& path, std::span<const std::byte> start) const override {
    return vtk_xml::is_file_of("UnstructuredGrid", ".vtu", path, start);
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const auto mesh = std::make_shared<MeshField>();
    mesh->source = o.name;
    mesh->sha256 = sha256({o.file->bytes()});
    mesh->gradient = mesh_gradient(p);
    mesh->tolerance = p.number("tolerance");
    const std::vector<MeshArray> arrays = arrays_of(o.header.pieces.front());
    const MeshChoice choice = choose_mesh_array(arrays, p, o.name, mesh->notes);
    const MeshArray& chosen = arrays[choice.array];
    mesh->notes.push_back("world frame: the file's own coordinates");
    std::vector<double> of_cells;
    for (const Piece& piece : o.header.pieces) add_piece(o, piece, chosen, choice, *mesh, of_cells);
    if (chosen.cells) set_cell_values(*mesh, of_cells);
    if (o.header.pieces.size() > 1)
      mesh->notes.push_back(std::to_string(o.header.pieces.size()) + " pieces were put together");
    finish_mesh(*mesh, context.nan_policy, context.nan_value);
    return mesh;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    std::uint64_t bytes = 0;
    // Numbers as read, as doubles or 64-bit indices, and in the mesh; 20 nodes per cell are the most.
    const std::uint64_t size = o.file->bytes().size();
    for (const Piece& piece : o.header.pieces) {
      const std::uint64_t points = std::min(piece.points, size), cells = std::min(piece.cells, size);
      std::uint64_t components = 1;
      for (const auto* list : {&piece.point_data, &piece.cell_data})
        for (const DataArray& a : *list)
          components = std::max(components, std::min<std::uint64_t>(static_cast<std::uint64_t>(a.components), 64));
      bytes += points * (2 * 24 + 32 + 16 * components) + cells * (20 * 24 + 48 + 16 * components);
    }
    return bytes;
  }

 private:
  static void add_piece(const Opened& o, const Piece& piece, const MeshArray& chosen, const MeshChoice& choice,
                        MeshField& mesh, std::vector<double>& of_cells) {
    const PieceReader read(o, piece);
    const std::uint64_t offset = mesh.point.size();
    add_points(mesh, read.doubles(read.places(), piece.points));
    const std::vector<std::int64_t> types = read.integers(read.topology("types"), piece.cells),
                                    ends = read.integers(read.topology("offsets"), piece.cells);
    const std::int64_t nodes = ends.empty() ? 0 : ends.back();
    if (nodes < 0) throw InputError(read.where(read.topology("offsets")) + ": its last number is negative");
    const std::vector<std::int64_t> connectivity =
        read.integers(read.topology("connectivity"), static_cast<std::uint64_t>(nodes));
    std::vector<std::uint64_t> kept;
    add_vtk_cells(mesh, types, connectivity, ends, offset, kept, o.name);
    const std::vector<double> values =
        scalars_of(read.doubles(array_of(piece, chosen, o.name), chosen.cells ? piece.cells : piece.points),
                   chosen.components, choice.component);
    if (chosen.cells)
      for (const std::uint64_t c : kept) of_cells.push_back(values[c]);
    else
      mesh.value.insert(mesh.value.end(), values.begin(), values.end());
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "vtu", "1.0.0", Vtu, parameters,
              "Reads an array of a VTK UnstructuredGrid file, .vtu: ascii, base64 or raw, compressed or not.",
              "VTK XML file formats, https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html")

}  // namespace dvrlab::vtu
