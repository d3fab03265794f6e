#include "framework/scene/mesh/mesh_array.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <type_traits>

#include "framework/interfaces/error.h"
#include "framework/plugin/registry.h"

namespace dvrlab {
namespace {

std::string list_of(const std::vector<MeshArray>& arrays) {
  std::string list;
  for (const MeshArray& a : arrays)
    list += (list.empty() ? "\"" : ", \"") + a.name + "\" (" + (a.cells ? "cells" : "points") +
            (a.components > 1 ? ", " + std::to_string(a.components) + " components)" : ")");
  return list;
}

std::size_t array_of(const std::vector<MeshArray>& arrays, const ParameterSet& p, const std::string& name) {
  if (arrays.empty()) throw InputError(name + ": holds no data of points or cells, only their places");
  const std::string wanted = p.text("array"), key = p.path_of("array");
  if (!wanted.empty()) {
    for (std::size_t k = 0; k < arrays.size(); ++k)
      if (arrays[k].name == wanted) return k;
    std::vector<std::string> names;
    for (const MeshArray& a : arrays) names.push_back(a.name);
    const std::string nearest = nearest_name(wanted, names);
    throw InputError(key + ": " + name + " has no array \"" + wanted + "\"" +
                     (nearest.empty() ? "" : ", the nearest is \"" + nearest + "\"") + "; it has " + list_of(arrays));
  }
  const auto only = [&](auto test) -> std::size_t {
    std::size_t found = arrays.size(), count = 0;
    for (std::size_t k = 0; k < arrays.size(); ++k)
      if (test(arrays[k])) {
        found = k;
        ++count;
      }
    return count == 1 ? found : arrays.size();
  };
  for (const std::size_t found :
       {only([](const MeshArray& a) { return a.active && !a.cells; }),
        only([](const MeshArray& a) { return !a.cells; }), only([](const MeshArray& a) { return a.active; }),
        only([](const MeshArray&) { return true; })})
    if (found < arrays.size()) return found;
  throw InputError(name + ": holds several arrays; choose one with " + key + ": " + list_of(arrays));
}

/// "component 2 of \"velocity\"", for notes.
std::string text_of(const MeshArray& array, const MeshChoice& choice) {
  const std::string name = "\"" + array.name + "\"";
  if (choice.component < 0) return "the norm of " + name;
  return array.components > 1 ? "component " + std::to_string(choice.component) + " of " + name : name;
}

}  // namespace

MeshChoice choose_mesh_array(const std::vector<MeshArray>& arrays, const ParameterSet& p, const std::string& name,
                             std::vector<std::string>& notes) {
  MeshChoice choice;
  choice.array = array_of(arrays, p, name);
  const MeshArray& a = arrays[choice.array];
  const std::string word = p.text("component"), key = p.path_of("component");
  const std::string has = name + ": array \"" + a.name + "\" has " + std::to_string(a.components) +
                          (a.components == 1 ? " component" : " components");
  if (a.components < 1) throw InputError(has);
  if (word == "norm") {
    choice.component = -1;
  } else if (word.empty()) {
    if (a.components > 1)
      throw InputError(has + ", and a field is a scalar; choose one with " + key + ", \"0\" to \"" +
                       std::to_string(a.components - 1) + "\", or \"norm\"");
  } else {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), choice.component);
    if (error != std::errc() || end != word.data() + word.size() || choice.component < 0 ||
        choice.component >= a.components)
      throw InputError(key + ": is \"" + word + "\"; must be \"0\" to \"" + std::to_string(a.components - 1) +
                       "\", or \"norm\" (" + has + ")");
  }
  if (arrays.size() > 1 || a.components > 1)
    notes.push_back((arrays.size() > 1 ? "of " + std::to_string(arrays.size()) + " arrays, " : "") +
                    text_of(a, choice) + " is read");
  return choice;
}

void add_points(MeshField& mesh, const std::vector<double>& places) {
  for (std::size_t k = 0; k + 2 < places.size(); k += 3)
    mesh.point.push_back({places[k], places[k + 1], places[k + 2]});
}

void set_cell_values(MeshField& mesh, const std::vector<double>& values) {
  mesh.value = points_of_cells(mesh, values);
  mesh.notes.push_back("values of cells were averaged to their points");
}

namespace {

/// Calls add(value) for each number, as the file's own type in this machine's byte order.
template <class Add>
void each_number(const SourceVoxels& source, std::uint64_t count, Add add) {
  with_source_type(source.type, [&]<class T>(T) {
    const auto* bytes = static_cast<const std::byte*>(source.data.get());
    for (std::uint64_t i = 0; i < count; ++i) {
      std::array<std::byte, sizeof(T)> one;
      std::memcpy(one.data(), bytes + i * sizeof(T), sizeof(T));
      if (source.swap) std::reverse(one.begin(), one.end());
      add(std::bit_cast<T>(one));
    }
  });
}

}  // namespace

std::vector<double> to_doubles(const SourceVoxels& source, std::uint64_t count) {
  std::vector<double> out;
  out.reserve(count);
  each_number(source, count, [&](auto x) { out.push_back(static_cast<double>(x)); });
  return out;
}

std::vector<std::int64_t> to_integers(const SourceVoxels& source, std::uint64_t count, const std::string& where) {
  std::vector<std::int64_t> out;
  out.reserve(count);
  each_number(source, count, [&]<class T>(T x) {
    if constexpr (std::is_floating_point_v<T>)
      throw InputError(where + ": holds numbers of type " + name_of(source.type) + "; indices are whole numbers");
    else if constexpr (std::is_same_v<T, std::uint64_t>)
      out.push_back(static_cast<std::int64_t>(std::min<std::uint64_t>(x, INT64_MAX)));
    else
      out.push_back(x);
  });
  return out;
}

std::vector<double> scalars_of(const std::vector<double>& numbers, long long components, long long component) {
  if (components == 1 && component == 0) return numbers;
  const auto n = static_cast<std::size_t>(components);
  std::vector<double> out(numbers.size() / n);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double* entry = numbers.data() + i * n;
    if (component >= 0) {
      out[i] = entry[component];
      continue;
    }
    double sum = 0;
    for (std::size_t c = 0; c < n; ++c) sum = std::hypot(sum, entry[c]);
    out[i] = sum;
  }
  return out;
}

namespace {

constexpr int voxel = 11;

/// The shape that VTK numbers so; -1 for cells without a volume.
int shape_of(std::int64_t type, std::uint64_t cell, const std::string& where) {
  for (int s = 0; s < cell_shapes; ++s)
    if (info_of(static_cast<CellShape>(s)).vtk_type == type) return s;
  if (type == voxel) return static_cast<int>(CellShape::hexahedron);
  static const std::map<std::int64_t, const char*> flat = {{0, ""},  {1, ""},  {2, ""},  {3, ""},  {4, ""},  {5, ""},
                                                           {6, ""},  {7, ""},  {8, ""},  {9, ""},  {21, ""}, {22, ""},
                                                           {23, ""}, {28, ""}, {30, ""}, {34, ""}, {35, ""}, {36, ""}};
  if (flat.contains(type)) return -1;
  static const std::map<std::int64_t, const char*> others = {
      {15, "a pentagonal prism"},   {16, "a hexagonal prism"},        {27, "a quadratic pyramid"},
      {29, "a 27-node hexahedron"}, {31, "a quadratic linear wedge"}, {32, "an 18-node wedge"},
      {33, "a 24-node hexahedron"}, {37, "a 19-node pyramid"},        {41, "a convex point set"},
      {42, "a polyhedron"},         {71, "a Lagrange tetrahedron"},   {72, "a Lagrange hexahedron"},
      {73, "a Lagrange wedge"}};
  const auto found = others.find(type);
  throw InputError(
      where + ": cell " + std::to_string(cell) + " is " +
      (found == others.end() ? "of an unknown type" : found->second) + " (VTK type " + std::to_string(type) +
      "); tetrahedra, hexahedra, voxels, wedges, pyramids, 10-node tetrahedra, 20-node hexahedra and 15-node "
      "wedges are read. ParaView's filter \"Tetrahedralize\" cuts any cell into tetrahedra");
}

}  // namespace

void add_vtk_cells(MeshField& mesh, const std::vector<std::int64_t>& types,
                   const std::vector<std::int64_t>& connectivity, const std::vector<std::int64_t>& ends,
                   std::uint64_t offset, std::vector<std::uint64_t>& kept, const std::string& where) {
  std::int64_t begin = 0;
  std::uint64_t flat = 0;
  const auto most = static_cast<std::int64_t>(connectivity.size());
  std::vector<std::uint32_t> nodes;
  for (std::uint64_t c = 0; c < types.size(); ++c) {
    const std::int64_t end = ends[c];
    if (end < begin || end > most)
      throw InputError(where + ": the nodes of cell " + std::to_string(c) + " end at " + std::to_string(end) +
                       ", behind " + std::to_string(begin) + " and at most " + std::to_string(most) + " are possible");
    const int s = shape_of(types[c], c, where);
    if (s < 0) {
      ++flat;
      begin = end;
      continue;
    }
    const auto shape = static_cast<CellShape>(s);
    if (end - begin != info_of(shape).nodes)
      throw InputError(where + ": cell " + std::to_string(c) + ", a " + info_of(shape).name + ", has " +
                       std::to_string(end - begin) + " nodes; it needs " + std::to_string(info_of(shape).nodes));
    nodes.clear();
    for (std::int64_t k = begin; k < end; ++k) {
      const std::int64_t n = connectivity[static_cast<std::size_t>(k)];
      if (n < 0 || n > std::int64_t{UINT32_MAX} - static_cast<std::int64_t>(offset))
        throw InputError(where + ": cell " + std::to_string(c) + " names the point " + std::to_string(n));
      nodes.push_back(static_cast<std::uint32_t>(static_cast<std::uint64_t>(n) + offset));
    }
    if (types[c] == voxel) {
      std::swap(nodes[2], nodes[3]);
      std::swap(nodes[6], nodes[7]);
    }
    mesh.add_cell(shape, nodes);
    kept.push_back(c);
    begin = end;
  }
  if (flat > 0)
    mesh.notes.push_back(std::to_string(flat) + (flat == 1 ? " cell" : " cells") +
                         " without a volume (points, lines, surfaces): left out");
}

}  // namespace dvrlab
