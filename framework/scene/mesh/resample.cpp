#include "framework/scene/mesh/resample.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/scene/mesh/elements.h"
#include "framework/scene/vector.h"

namespace dvrlab {
namespace {

constexpr double margin = 1e-9;  // of reference coordinates: faces belong to their cells

bool holds(CellShape shape, const Vector3& r) {
  if (*std::min_element(r.begin(), r.end()) < -margin) return false;
  const int corners = info_of(shape).corners;
  if (corners == 4) return r[0] + r[1] + r[2] <= 1 + margin;
  if (corners == 6) return r[0] + r[1] <= 1 + margin && r[2] <= 1 + margin;
  return *std::max_element(r.begin(), r.end()) <= 1 + margin;
}

/// The solution of J^T d = b, J the rows of the derivatives; nothing where they span no volume.
std::optional<Vector3> solve(const std::array<std::array<double, 4>, 3>& j, const Vector3& b) {
  const auto row = [&](std::size_t k) { return Vector3{j[k][0], j[k][1], j[k][2]}; };
  const double volume = dot(row(0), cross(row(1), row(2)));
  if (!(std::abs(volume) > 1e-300)) return std::nullopt;
  return Vector3{dot(b, cross(row(1), row(2))) / volume, dot(row(0), cross(b, row(2))) / volume,
                 dot(row(0), cross(row(1), b)) / volume};
}

/// The value of the cell at x, nothing outside of it.
std::optional<double> value_at(const Element4& e, CellShape shape, const Vector3& x, double size) {
  Vector3 r = reference_centre(shape);
  for (int k = 0; k < 20; ++k) {
    const std::array<double, 4> at = evaluate(e, r);
    const Vector3 missing{x[0] - at[0], x[1] - at[1], x[2] - at[2]};
    if (length(missing) <= 1e-10 * size) return holds(shape, r) ? std::optional(at[3]) : std::nullopt;
    const std::optional<Vector3> step = solve(derivatives(e, r), missing);
    if (!step) return std::nullopt;
    r = plus(r, *step);
    if (length(r) > 10) return std::nullopt;  // far outside: the search has left the cell
  }
  return std::nullopt;
}

struct Box {
  Vector3 lo, hi;
};

/// Of the cell's nodes in sampler coordinates; curved faces may bulge beyond them.
Box box_of(const MeshField& mesh, std::uint64_t cell, const Affine& to_sampler) {
  Box b{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
  for (const std::uint32_t n : mesh.nodes_of(cell)) {
    const Vector3 p = to_sampler.point(mesh.point[n]);
    for (std::size_t a = 0; a < 3; ++a) {
      b.lo[a] = std::min(b.lo[a], p[a]);
      b.hi[a] = std::max(b.hi[a], p[a]);
    }
  }
  const CellShapeInfo& info = info_of(mesh.shape[cell]);
  const double bulge = info.nodes > info.corners ? 0.25 : 1e-9;
  for (std::size_t a = 0; a < 3; ++a) {
    const double more = bulge * (b.hi[a] - b.lo[a]);
    b.lo[a] -= more;
    b.hi[a] += more;
  }
  return b;
}

}  // namespace

ResampledMesh resample(const MeshField& mesh, const std::array<int, 3>& dims) {
  ResampledMesh r;
  r.dims = dims;
  const std::size_t count = std::size_t(dims[0]) * std::size_t(dims[1]) * std::size_t(dims[2]);
  r.value.assign(count, 0.0f);
  r.inside.assign(count, 0.0f);
  const Affine to_sampler = mesh.to_world.inverse();
  Vector3 step;
  for (std::size_t a = 0; a < 3; ++a) step[a] = (mesh.hi[a] - mesh.lo[a]) / (dims[a] - 1);
  for (std::uint64_t cell = 0; cell < mesh.cells(); ++cell) {
    const Box box = box_of(mesh, cell, to_sampler);
    std::array<int, 3> first, last;
    for (std::size_t a = 0; a < 3; ++a) {
      first[a] = std::max(0, static_cast<int>(std::ceil((box.lo[a] - mesh.lo[a]) / step[a] - 1e-6)));
      last[a] = std::min(dims[a] - 1, static_cast<int>(std::floor((box.hi[a] - mesh.lo[a]) / step[a] + 1e-6)));
    }
    if (first[0] > last[0] || first[1] > last[1] || first[2] > last[2]) continue;
    const Element4 e = element_of(mesh, cell);
    const double size = length(mesh.to_world.vector(minus(box.hi, box.lo)));
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          const std::size_t at =
              (std::size_t(z) * std::size_t(dims[1]) + std::size_t(y)) * std::size_t(dims[0]) + std::size_t(x);
          if (r.inside[at] != 0) continue;
          const Vector3 p{mesh.lo[0] + x * step[0], mesh.lo[1] + y * step[1], mesh.lo[2] + z * step[2]};
          const std::optional<double> v = value_at(e, mesh.shape[cell], mesh.to_world.point(p), size);
          if (!v) continue;
          r.value[at] = static_cast<float>((*v - mesh.intercept) / mesh.slope);
          r.inside[at] = 1;
        }
  }
  return r;
}

}  // namespace dvrlab
