// The reader of Exodus II files: finite-element results of many codes, a convention in netCDF.
#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <map>
#include <string_view>

#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh_keys.h"
#include "framework/report/number_text.h"
#include "framework/scene/child.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/mesh/mesh_array.h"
#include "framework/scene/sha256.h"
#include "plugins/data/exodus/exodus_file.h"

namespace dvrlab::exodus {
namespace {

constexpr Parameter parameters[] = {
    {"file", ParameterType::text, "", nullptr, "",
     "The Exodus II file (.exo, .ex2, .e, .g), relative to the config's folder; ${NAME} reads the environment.",
     Affects::pixels, "{}", R"("../../../data/notch_end.exo")"},
    seen_in(mesh_array_key, R"({"data":{"component":""}})", R"("diagonal")"),
    seen_in(mesh_component_key, "{}", R"("0")"),
    {"time_step", ParameterType::integer, "", "-1", "[-1,1000000000]", "Which time step, from 0; -1: the last one.",
     Affects::pixels, "{}", "0"},
    mesh_normals_key,
    mesh_tolerance_key};

struct Opened {
  std::string name;
  std::shared_ptr<const MappedFile> file;
};

Opened open(const ParameterSet& p, const LoadContext& context) {
  const std::string name = resolve_path(p.text("file"), context, p.path_of("file"));
  return {name, MappedFile::open(name)};
}

/// Of the library, beside what it is asked for: a damaged header asks it for more.
std::uint64_t memory_beside(const Opened& o) { return (std::uint64_t{256} << 20) + 4 * o.file->bytes().size(); }

double bytes_of(const ExodusFile& f) {
  double bytes = static_cast<double>(f.points()) * (24 * 3 + 40 + 32);
  for (const Block& b : f.blocks()) bytes += static_cast<double>(b.cells) * (64 + 24 * static_cast<double>(b.nodes));
  return bytes;
}

std::uint64_t step_of(const ParameterSet& p, const ExodusFile& f, const std::string& name) {
  const long long wanted = p.integer("time_step");
  if (f.steps() == 0) throw InputError(name + ": holds no values, only cells and their places (no time step)");
  if (wanted < 0) return f.steps() - 1;
  if (static_cast<std::uint64_t>(wanted) >= f.steps())
    throw InputError(p.path_of("time_step") + ": is " + std::to_string(wanted) + "; " + name + " has " +
                     std::to_string(f.steps()) + " time steps, 0 to " + std::to_string(f.steps() - 1));
  return static_cast<std::uint64_t>(wanted);
}

/// Scalars that are called after the axes are the components of a vector.
struct Offer {
  MeshArray array;
  std::vector<std::size_t> variable;  // one per component
};

std::vector<Offer> offers_of(const std::vector<Variable>& variables) {
  const auto stem = [&](std::size_t k, char axis) -> std::string {
    if (k >= variables.size() || variables[k].name.size() < 2) return "";
    std::string name = variables[k].name;
    if (std::toupper(static_cast<unsigned char>(name.back())) != axis) return "";
    name.pop_back();
    return name;
  };
  std::vector<Offer> list;
  for (std::size_t k = 0; k < variables.size();) {
    std::string name = stem(k, 'X');
    const bool vector = !name.empty() && stem(k + 1, 'Y') == name && stem(k + 2, 'Z') == name &&
                        variables[k + 1].cells == variables[k].cells && variables[k + 2].cells == variables[k].cells;
    Offer offer;
    offer.array.name = variables[k].name;
    offer.array.cells = variables[k].cells;
    if (vector) {
      while (name.size() > 1 && (name.back() == '_' || name.back() == ' ')) name.pop_back();
      offer.array.name = name;
      offer.array.components = 3;
    }
    for (std::size_t c = 0; c < static_cast<std::size_t>(offer.array.components); ++c) offer.variable.push_back(k + c);
    list.push_back(offer);
    k += offer.variable.size();
  }
  return list;
}

/// VTK's number of a block's cells; those without a volume have one that is left out.
int vtk_type(const Block& b, const std::string& name) {
  const auto is = [&](std::string_view start) { return b.type.starts_with(start); };
  const std::map<std::uint64_t, int> tetrahedra = {{4, 10}, {10, 24}}, hexahedra = {{8, 12}, {20, 25}, {27, 29}},
                                     wedges = {{6, 13}, {15, 26}, {18, 32}}, pyramids = {{5, 14}, {13, 27}};
  const auto of = [&](const std::map<std::uint64_t, int>& known) {
    const auto found = known.find(b.nodes);
    if (found != known.end()) return found->second;
    throw InputError(name + ": block " + std::to_string(b.number) + ", cells of type \"" + b.type + "\", has " +
                     std::to_string(b.nodes) + " nodes for each, which no cell of that type has that is read");
  };
  if (is("TET")) return of(tetrahedra);
  if (is("HEX")) return of(hexahedra);
  if (is("WED")) return of(wedges);
  if (is("PYR")) return of(pyramids);
  if (is("NFACED")) return 42;
  for (const char* flat : {"SPHERE", "CIRCLE", "BAR", "BEAM", "TRUSS", "ROD", "EDGE", "SHELL", "QUAD", "TRI", "NSIDED"})
    if (is(flat)) return 3;
  throw InputError(name + ": block " + std::to_string(b.number) + " has cells of the unknown type \"" + b.type +
                   "\"; TETRA, HEX, WEDGE and PYRAMID are read");
}

/// Exodus lists the middles of the upright edges before those of the upper ones, VTK behind them.
void in_order_of_vtk(std::vector<std::int64_t>& node, std::size_t cells, std::size_t nodes) {
  const std::size_t upright = nodes == 20 ? 12 : nodes == 15 ? 9 : 0, edges = nodes == 20 ? 4 : 3;
  if (upright == 0) return;
  for (std::size_t c = 0; c < cells; ++c) {
    const auto from = node.begin() + static_cast<std::ptrdiff_t>(c * nodes + upright);
    std::rotate(from, from + static_cast<std::ptrdiff_t>(edges), from + static_cast<std::ptrdiff_t>(2 * edges));
  }
}

void add_cells(const ExodusFile& f, const std::string& name, MeshField& mesh, std::vector<std::uint64_t>& kept) {
  std::vector<std::int64_t> types, nodes, ends;
  for (const Block& b : f.blocks()) {
    const int type = vtk_type(b, name);
    std::vector<std::int64_t> own = f.connectivity(b);
    if (type == 25 || type == 26) in_order_of_vtk(own, b.cells, b.nodes);
    for (std::uint64_t c = 1; c <= b.cells; ++c) {
      types.push_back(type);
      ends.push_back(static_cast<std::int64_t>(nodes.size() + c * b.nodes));
    }
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  add_vtk_cells(mesh, types, nodes, ends, 0, kept, name);
}

std::vector<double> scalars(const ExodusFile& f, const Offer& offer, long long component, std::uint64_t step) {
  const auto& variables = f.variables();
  if (component >= 0) return f.values(variables[offer.variable[static_cast<std::size_t>(component)]], step);
  std::vector<double> numbers;
  for (std::size_t a = 0; a < offer.variable.size(); ++a) {
    const std::vector<double> x = f.values(variables[offer.variable[a]], step);
    numbers.resize(x.size() * offer.variable.size());
    for (std::size_t k = 0; k < x.size(); ++k) numbers[k * offer.variable.size() + a] = x[k];
  }
  return scalars_of(numbers, static_cast<long long>(offer.variable.size()), -1);
}

/// All that the library is needed for.
void read(const Opened& o, const ParameterSet& p, MeshField& mesh) {
  const ExodusFile f(o.file->bytes(), o.name);
  const std::uint64_t step = step_of(p, f, o.name);
  if (f.steps() > 1)
    mesh.notes.push_back("time step " + std::to_string(step) + " of " + std::to_string(f.steps()) +
                         ", t = " + number_text(f.time(step)));
  const std::vector<Offer> offers = offers_of(f.variables());
  std::vector<MeshArray> arrays;
  for (const Offer& offer : offers) arrays.push_back(offer.array);
  const MeshChoice choice = choose_mesh_array(arrays, p, o.name, mesh.notes);
  const Offer& chosen = offers[choice.array];
  add_points(mesh, f.places());
  std::vector<std::uint64_t> kept;
  add_cells(f, o.name, mesh, kept);
  const std::vector<double> values = scalars(f, chosen, choice.component, step);
  if (chosen.array.cells) {
    std::vector<double> of_cells;
    for (const std::uint64_t c : kept) of_cells.push_back(values[c]);
    set_cell_values(mesh, of_cells);
  } else {
    mesh.value = values;
  }
}

class Exodus : public DataPlugin {
 public:
  // Every netCDF file of the classic kinds; of HDF5 files those with a name of Exodus.
  bool recognises(const std::string& path, std::span<const std::byte> start) const override {
    const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
    if (text.starts_with("CDF")) return true;
    std::string end = std::filesystem::path(path).extension().string();
    std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
    constexpr std::string_view names[] = {".exo", ".ex2", ".exii", ".e", ".g"};
    return text.starts_with("\211HDF") && std::find(std::begin(names), std::end(names), end) != std::end(names);
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    // A rehearsal: what the library does not survive ends there.
    in_child("netCDF", memory_beside(o) + 2 * bytes_needed(p, context), [&] {
      reading(o.name);
      MeshField mesh;
      read(o, p, mesh);
      return Bytes{};
    });
    const auto mesh = std::make_shared<MeshField>();
    mesh->source = o.name;
    mesh->sha256 = sha256({o.file->bytes()});
    mesh->gradient = mesh_gradient(p);
    mesh->tolerance = p.number("tolerance");
    mesh->notes.push_back("world frame: the file's own coordinates");
    read(o, p, *mesh);
    finish_mesh(*mesh, context.nan_policy, context.nan_value);
    return mesh;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const Bytes sent = in_child("netCDF", memory_beside(o), [&] {
      reading(o.name);
      const double bytes = bytes_of(ExodusFile(o.file->bytes(), o.name));
      Bytes sending(sizeof bytes);
      std::memcpy(sending.data(), &bytes, sizeof bytes);
      return sending;
    });
    double bytes = 0;
    std::memcpy(&bytes, sent.data(), std::min(sent.size(), sizeof bytes));
    return static_cast<std::uint64_t>(std::min(bytes, 4e18));
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "exodus", "1.0.0", Exodus, parameters,
              "Reads a variable of the points or cells of an Exodus II file, at one time step.",
              "G. Sjaardema et al., EXODUS II: A Finite Element Data Model, Sandia National Laboratories, SAND92-2137 "
              "and later; netCDF, https://www.unidata.ucar.edu/software/netcdf")

}  // namespace dvrlab::exodus
