#include "plugins/data/vti/pieces.h"

#include <algorithm>

#include "framework/interfaces/error.h"
#include "framework/plugin/registry.h"
#include "framework/vtk_xml/array_values.h"

namespace dvrlab::vti {
namespace {

std::string text_of(const Extent& e) {
  std::string text;
  for (const long long x : e) text += (text.empty() ? "" : " ") + std::to_string(x);
  return '"' + text + '"';
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& n : names) list += (list.empty() ? "\"" : ", \"") + n + '"';
  return list;
}

const DataArray& choose_array(const Piece& piece, const Wanted& wanted, const std::string& name) {
  std::vector<std::string> names;
  for (const DataArray& a : piece.arrays) names.push_back(a.name);
  if (names.empty())
    throw InputError(name + (piece.cell_arrays > 0
                                 ? ": holds cell data only, and a volume's values sit at the points; store it as point "
                                   "data (filter \"Cell Data to Point Data\" of ParaView, vtkCellDataToPointData)"
                                 : ": holds no point data (<PointData> with a <DataArray>)"));
  const std::string& chosen = wanted.array.empty() ? piece.scalars : wanted.array;
  if (chosen.empty()) {
    if (names.size() == 1) return piece.arrays.front();
    throw InputError(name + ": holds several arrays and names none as active; choose one with " + wanted.array_key +
                     ": " + list_of(names));
  }
  const auto found = std::find(names.begin(), names.end(), chosen);
  if (found != names.end()) return piece.arrays[static_cast<std::size_t>(found - names.begin())];
  if (wanted.array.empty())
    throw InputError(name + ": its active array \"" + chosen + "\" is not there; choose one with " + wanted.array_key +
                     ": " + list_of(names));
  const std::string nearest = nearest_name(chosen, names);
  throw InputError(wanted.array_key + ": " + name + " has no array \"" + chosen + "\"" +
                   (nearest.empty() ? "" : ", the nearest is \"" + nearest + "\"") + "; it has " + list_of(names));
}

std::size_t choose_component(const DataArray& array, const Wanted& wanted, const std::string& where) {
  const long long n = array.components, chosen = wanted.component;
  if (n < 1) throw InputError(where + ": has no components");
  if (chosen < 0 && n > 1)
    throw InputError(where + ": has " + std::to_string(n) + " components, and a volume is a scalar; choose one with " +
                     wanted.component_key + ", 0 to " + std::to_string(n - 1));
  if (chosen >= n)
    throw InputError(wanted.component_key + ": is " + std::to_string(chosen) + ", but the array has " +
                     std::to_string(n) + (n == 1 ? " component" : " components, 0 to " + std::to_string(n - 1)) + " (" +
                     where + ")");
  return static_cast<std::size_t>(std::max(chosen, 0ll));
}

// Pieces share the points of their common faces, so it is the cells that must fill the extent once.
void check_fit(const std::vector<Part>& parts, const Extent& whole, const std::string& name) {
  const auto cells = [](const Extent& e) {
    return static_cast<std::uint64_t>(e[1] - e[0]) * static_cast<std::uint64_t>(e[3] - e[2]) *
           static_cast<std::uint64_t>(e[5] - e[4]);
  };
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Extent& a = parts[i].extent;
    for (std::size_t x = 0; x < 6; x += 2)
      if (a[x] > a[x + 1] || a[x] < whole[x] || a[x + 1] > whole[x + 1])
        throw InputError(name + ": the piece " + text_of(a) + " does not lie in the WholeExtent " + text_of(whole));
    for (std::size_t j = 0; j < i; ++j) {
      const Extent& b = parts[j].extent;
      bool apart = false;
      for (std::size_t x = 0; x < 6; x += 2) apart = apart || a[x + 1] <= b[x] || b[x + 1] <= a[x];
      if (!apart) throw InputError(name + ": the pieces " + text_of(b) + " and " + text_of(a) + " overlap");
    }
    sum += cells(a);
  }
  if (sum != cells(whole))
    throw InputError(name + ": the pieces leave a part of the WholeExtent " + text_of(whole) + " empty");
}

}  // namespace

Parts choose_parts(const VtiHeader& header, const Wanted& wanted, const std::string& name) {
  grid_bytes(dims_of(header.whole), 1, name + ": WholeExtent");
  Parts parts;
  for (const Piece& piece : header.pieces) {
    const DataArray& array = choose_array(piece, wanted, name);
    const std::string where = name + ": line " + std::to_string(array.line) + ": array \"" + array.name + "\"";
    const SourceType type = type_of(array, where);
    parts.component = choose_component(array, wanted, where);
    if (!parts.part.empty() && type != parts.type)
      throw InputError(where + ": is " + name_of(type) + " here and " + name_of(parts.type) + " in another piece");
    parts.type = type;
    parts.part.push_back({array, piece.extent, 0, where});
  }
  check_fit(parts.part, header.whole, name);
  for (Part& p : parts.part) {
    std::uint64_t& n = p.numbers = static_cast<std::uint64_t>(p.array.components);
    for (const long long d : dims_of(p.extent))
      if (__builtin_mul_overflow(n, static_cast<std::uint64_t>(d), &n) || n >> 59)
        throw InputError(p.where + ": its extent and its components overflow; no memory holds such a volume");
  }
  return parts;
}

void place_part(const Part& part, const SourceVoxels& values, std::size_t component, const Extent& whole,
                std::byte* volume) {
  const std::size_t size = bytes_of(values.type), stride = size * static_cast<std::size_t>(part.array.components);
  const auto dims = dims_of(whole);
  const Extent& e = part.extent;
  const auto* in = static_cast<const std::byte*>(values.data.get()) + size * component;
  for (long long z = e[4]; z <= e[5]; ++z)
    for (long long y = e[2]; y <= e[3]; ++y) {
      std::byte* out = volume + size * static_cast<std::size_t>(((z - whole[4]) * dims[1] + (y - whole[2])) * dims[0] +
                                                                (e[0] - whole[0]));
      for (long long x = e[0]; x <= e[1]; ++x, in += stride, out += size)
        values.swap ? std::reverse_copy(in, in + size, out) : std::copy_n(in, size, out);
    }
}

}  // namespace dvrlab::vti
