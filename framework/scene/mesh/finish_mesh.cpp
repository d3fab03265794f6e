#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh.h"
#include "framework/scene/mesh/elements.h"
#include "framework/scene/mesh/tetrahedra.h"

namespace dvrlab {
namespace {

std::string text_of(const Vector3& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", p[0], p[1], p[2]);
  return text;
}

void check_indices(const MeshField& mesh) {
  if (mesh.cells() == 0) throw InputError(mesh.source + ": the mesh holds no cells");
  for (std::uint64_t c = 0; c < mesh.cells(); ++c)
    for (const std::uint32_t n : mesh.nodes_of(c))
      if (n >= mesh.point.size())
        throw InputError(mesh.source + ": cell " + std::to_string(c) + " names the point " + std::to_string(n) +
                         "; there are " + std::to_string(mesh.point.size()) + " (0 to " +
                         std::to_string(mesh.point.size() - 1) + ")");
}

void check_numbers(MeshField& mesh, const std::string& nan_policy, double nan_value) {
  for (std::size_t p = 0; p < mesh.point.size(); ++p)
    for (const double x : mesh.point[p])
      if (!std::isfinite(x))
        throw InputError(mesh.source + ": point " + std::to_string(p) + " lies at " + text_of(mesh.point[p]) +
                         "; coordinates must be finite");
  std::uint64_t replaced = 0;
  for (std::size_t p = 0; p < mesh.value.size(); ++p) {
    if (std::isfinite(mesh.value[p])) continue;
    if (nan_policy != "replace")
      throw InputError(mesh.source + ": the value of point " + std::to_string(p) + " is " +
                       std::to_string(mesh.value[p]) +
                       "; set data.nan_policy to \"replace\" (and data.nan_value) to go on without such values");
    mesh.value[p] = nan_value;
    ++replaced;
  }
  if (replaced > 0)
    mesh.notes.push_back(std::to_string(replaced) + " values that are not finite were replaced by " +
                         std::to_string(nan_value));
}

/// Points of equal place and value become the first of them.
void merge_points(MeshField& mesh) {
  const std::size_t n = mesh.point.size();
  std::vector<std::uint32_t> order(n), same(n);
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    const Vector3& p = mesh.point[i];
    return std::array<double, 4>{p[0], p[1], p[2], mesh.value[i]};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::iota(same.begin(), same.end(), 0u);
  for (std::size_t k = 1; k < n; ++k)
    if (key(order[k]) == key(order[k - 1])) {
      same[order[k]] = same[order[k - 1]];
      ++mesh.faults.merged_points;
    }
  if (mesh.faults.merged_points > 0)
    for (std::uint32_t& i : mesh.node) i = same[i];
}

/// Cells for which `drop` says so go.
template <class Drop>
std::uint64_t drop_cells(MeshField& mesh, Drop drop) {
  std::uint64_t kept = 0, dropped = 0;
  std::uint64_t to = 0;
  for (std::uint64_t c = 0; c < mesh.cells(); ++c) {
    const std::uint64_t begin = mesh.first[c], end = mesh.first[c + 1];
    if (drop(c)) {
      ++dropped;
      continue;
    }
    std::copy(mesh.node.begin() + static_cast<std::ptrdiff_t>(begin),
              mesh.node.begin() + static_cast<std::ptrdiff_t>(end),
              mesh.node.begin() + static_cast<std::ptrdiff_t>(to));
    mesh.shape[kept] = mesh.shape[c];
    mesh.first[kept] = to;
    to += end - begin;
    ++kept;
  }
  mesh.shape.resize(kept);
  mesh.first.resize(kept + 1);
  mesh.first[kept] = to;
  mesh.node.resize(to);
  return dropped;
}

std::vector<bool> repeated_cells(const MeshField& mesh) {
  struct Entry {
    std::uint64_t hash;
    std::uint32_t cell;
  };
  std::vector<Entry> entries(mesh.cells());
  for (std::uint64_t c = 0; c < mesh.cells(); ++c) {
    std::uint64_t sum = mesh.nodes_of(c).size();
    for (const std::uint32_t n : mesh.nodes_of(c)) {  // of any order
      std::uint64_t x = n + 0x9e3779b97f4a7c15ull;
      x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
      sum += x ^ (x >> 27);
    }
    entries[c] = {sum, static_cast<std::uint32_t>(c)};
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.hash != b.hash ? a.hash < b.hash : a.cell < b.cell; });
  std::vector<bool> repeated(mesh.cells(), false);
  const auto sorted = [&](std::uint32_t c) {
    std::vector<std::uint32_t> n(mesh.nodes_of(c).begin(), mesh.nodes_of(c).end());
    std::sort(n.begin(), n.end());
    return n;
  };
  for (std::size_t a = 0; a < entries.size();) {
    std::size_t b = a + 1;
    for (; b < entries.size() && entries[b].hash == entries[a].hash; ++b)
      if (sorted(entries[b].cell) == sorted(entries[a].cell)) repeated[entries[b].cell] = true;
    a = b;
  }
  return repeated;
}

/// Signed volume of a cell with flat faces: the sum over its faces, which are listed as seen from outside.
double cell_volume(const MeshField& mesh, std::uint64_t cell) {
  const CellShapeInfo& shape = info_of(mesh.shape[cell]);
  const auto nodes = mesh.nodes_of(cell);
  const auto at = [&](std::int8_t k) -> const Vector3& { return mesh.point[nodes[static_cast<std::size_t>(k)]]; };
  double sum = 0;
  for (const auto& f : shape.faces) {
    sum += volume6(at(0), at(f[0]), at(f[1]), at(f[2]));
    if (f[3] >= 0) sum += volume6(at(0), at(f[0]), at(f[2]), at(f[3]));
  }
  return sum / 6;
}

double length_of(const Vector3& a, const Vector3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// Volumes and edges: inverted and flat cells are counted; the mean length of an edge is the unit "voxel".
void judge_cells(MeshField& mesh) {
  double edges = 0;
  std::uint64_t count = 0;
  for (std::uint64_t c = 0; c < mesh.cells(); ++c) {
    const CellShapeInfo& shape = info_of(mesh.shape[c]);
    bool flat = false;
    const auto corners = mesh.nodes_of(c).first(static_cast<std::size_t>(shape.corners));
    for (std::size_t a = 0; a < corners.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        mesh.longest = std::max(mesh.longest, length_of(mesh.point[corners[a]], mesh.point[corners[b]]));
    for (const auto& t : tetrahedra_of_cell(shape, mesh.node.data() + mesh.first[c])) {
      const auto at = [&](std::size_t k) -> const Vector3& { return mesh.point[static_cast<std::size_t>(t[k])]; };
      double longest = 0;
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b) {
          const double l = length_of(at(a), at(b));
          longest = std::max(longest, l);
          edges += l;
          ++count;
        }
      flat = flat || std::abs(volume6(at(0), at(1), at(2), at(3))) <= 1e-12 * longest * longest * longest;
    }
    mesh.faults.flat_cells += flat ? 1 : 0;
    mesh.faults.inverted_cells += cell_volume(mesh, c) < 0 ? 1 : 0;
  }
  mesh.voxel = edges / static_cast<double>(count);
}

void drop_unused_points(MeshField& mesh) {
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.point.size(), 0);
  for (const std::uint32_t n : mesh.node) place[n] = 1;
  std::uint32_t kept = 0;
  for (std::size_t p = 0; p < place.size(); ++p) {
    if (place[p] == 0) {
      place[p] = unused;
      continue;
    }
    mesh.point[kept] = mesh.point[p];
    mesh.value[kept] = mesh.value[p];
    place[p] = kept++;
  }
  mesh.faults.unused_points = mesh.point.size() - kept - mesh.faults.merged_points;
  if (kept == mesh.point.size()) return;
  mesh.point.resize(kept);
  mesh.value.resize(kept);
  for (std::uint32_t& n : mesh.node) n = place[n];
}

void set_frame(MeshField& mesh) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vector3 lo{inf, inf, inf}, hi{-inf, -inf, -inf};
  for (const Vector3& p : mesh.point)
    for (std::size_t a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], p[a]);
      hi[a] = std::max(hi[a], p[a]);
    }
  const double half = 0.5 * length_of(lo, hi);
  if (!(half > 0) || !std::isfinite(half))
    throw InputError(mesh.source + ": the points span no box, from " + text_of(lo) + " to " + text_of(hi));
  mesh.to_world.m = {half, 0, 0, 0, half, 0, 0, 0, half};
  for (std::size_t a = 0; a < 3; ++a) {
    mesh.to_world.t[a] = 0.5 * (lo[a] + hi[a]);
    mesh.hi[a] = 0.5 * (hi[a] - lo[a]) / half;
    mesh.lo[a] = -mesh.hi[a];
  }
}

std::string range_text(double lo, double hi) {
  char text[80];
  std::snprintf(text, sizeof text, "%.9g to %.9g", lo, hi);
  return text;
}

void set_range(MeshField& mesh) {
  const auto [lo, hi] = value_range(mesh);
  mesh.intercept = lo;
  mesh.slope = hi > lo ? hi - lo : 1;
  mesh.stored_min = 0;
  mesh.stored_max = hi > lo ? 1 : 0;
  const auto [a, b] = std::minmax_element(mesh.value.begin(), mesh.value.end());
  // A billionth of the range is rounding, and so is what nine digits do not show.
  const double rounding = 1e-9 * (*b - *a);
  const std::string nodes = range_text(*a, *b), inside = range_text(lo, hi);
  if ((lo < *a - rounding || hi > *b + rounding) && inside != nodes)
    mesh.notes.push_back("values inside cells go from " + inside + ", beyond those of the nodes, " + nodes);
}

void say_faults(MeshField& mesh) {
  const MeshFaults& f = mesh.faults;
  const auto say = [&](std::uint64_t n, const char* one, const char* many, const char* what) {
    if (n > 0) mesh.notes.push_back(std::to_string(n) + " " + (n == 1 ? one : many) + " " + what);
  };
  say(f.merged_points, "point coincides", "points coincide", "with others of the same value: merged");
  say(f.unused_points, "point belongs", "points belong", "to no cell: dropped");
  say(f.duplicate_cells, "cell has", "cells have", "the nodes of an earlier one: dropped");
  say(f.collapsed_cells, "cell has", "cells have", "no volume, since nodes coincide: dropped");
  say(f.flat_cells, "cell is", "cells are", "flat, or has a flat corner: kept");
  say(f.inverted_cells, "cell is", "cells are", "inverted (negative volume): taken as found");
}

}  // namespace

std::vector<double> points_of_cells(const MeshField& mesh, std::span<const double> values) {
  std::vector<double> sum(mesh.point.size(), 0);
  std::vector<std::uint32_t> count(mesh.point.size(), 0);
  for (std::uint64_t c = 0; c < mesh.cells(); ++c)
    for (const std::uint32_t n : mesh.nodes_of(c)) {
      if (n >= sum.size()) continue;  // finish_mesh refuses it by name
      sum[n] += values[c];
      ++count[n];
    }
  for (std::size_t p = 0; p < sum.size(); ++p)
    if (count[p] > 0) sum[p] /= count[p];
  return sum;
}

void finish_mesh(MeshField& mesh, const std::string& nan_policy, double nan_value) {
  check_indices(mesh);
  check_numbers(mesh, nan_policy, nan_value);
  merge_points(mesh);
  const std::vector<bool> repeated = repeated_cells(mesh);
  mesh.faults.duplicate_cells = drop_cells(mesh, [&](std::uint64_t c) { return repeated[c]; });
  mesh.faults.collapsed_cells = drop_cells(mesh, [&](std::uint64_t c) {
    return tetrahedra_of_cell(info_of(mesh.shape[c]), mesh.node.data() + mesh.first[c]).empty();
  });
  if (mesh.cells() == 0) throw InputError(mesh.source + ": no cell has a volume");
  drop_unused_points(mesh);
  const bool linear =
      std::all_of(mesh.shape.begin(), mesh.shape.end(), [](CellShape s) { return info_of(s).linear(); });
  mesh.sampler = linear ? "mesh" : "curved_mesh";
  judge_cells(mesh);
  set_frame(mesh);
  set_range(mesh);
  say_faults(mesh);
}

}  // namespace dvrlab
