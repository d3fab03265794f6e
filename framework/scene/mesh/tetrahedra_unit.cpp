#include "framework/scene/mesh/tetrahedra_unit.h"

#include "framework/scene/buffers.h"
#include "framework/scene/mesh/mesh_gradients.h"
#include "framework/scene/mesh/tetrahedra.h"

namespace dvrlab {
namespace {

Buffer vertex_buffer(const MeshField& mesh) {
  std::vector<double> rows;
  rows.reserve(4 * mesh.point.size());
  for (std::size_t p = 0; p < mesh.point.size(); ++p) {
    const Vector3 x = sampler_point(mesh, mesh.point[p]);
    rows.insert(rows.end(), {x[0], x[1], x[2], (mesh.value[p] - mesh.intercept) / mesh.slope});
  }
  return vec4_buffer("tetrahedra_vertex", std::move(rows));
}

Buffer cell_buffer(const Tetrahedra& t) {
  std::vector<std::int32_t> rows;
  rows.reserve(8 * t.vertex.size());
  for (std::size_t j = 0; j < t.vertex.size(); ++j) {
    rows.insert(rows.end(), t.vertex[j].begin(), t.vertex[j].end());
    rows.insert(rows.end(), t.neighbour[j].begin(), t.neighbour[j].end());
  }
  return make_buffer("tetrahedra_cell", Element::ivec4, std::move(rows), 2 * t.vertex.size());
}

Buffer face_buffer(const Tetrahedra& t) {
  std::vector<std::int32_t> rows;
  rows.reserve(4 * t.boundary.size());
  for (const Tetrahedra::BoundaryFace& f : t.boundary)
    rows.insert(rows.end(), {f.vertex[0], f.vertex[1], f.vertex[2], f.tetrahedron});
  return make_buffer("tetrahedra_face", Element::ivec4, std::move(rows), t.boundary.size());
}

EntrySurface entry_surface(const MeshField& mesh, const Tetrahedra& t) {
  auto faces = std::make_shared<std::vector<std::array<std::array<float, 3>, 3>>>();
  faces->reserve(t.boundary.size());
  for (const Tetrahedra::BoundaryFace& f : t.boundary) {
    auto& face = faces->emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 x = sampler_point(mesh, mesh.point[static_cast<std::size_t>(f.vertex[k])]);
      for (std::size_t a = 0; a < 3; ++a) face[k][a] = static_cast<float>(x[a]);
    }
  }
  return {"tetrahedra_entry", std::move(faces)};
}

}  // namespace

Vector3 sampler_point(const MeshField& mesh, const Vector3& p) {
  Vector3 x;
  for (std::size_t a = 0; a < 3; ++a) x[a] = (p[a] - mesh.to_world.t[a]) / mesh.to_world.m[0];
  return x;
}

void add_tetrahedra(const MeshField& mesh, KernelUnit& unit) {
  const Tetrahedra& t = tetrahedra_in(mesh);
  for (Buffer b : {cell_buffer(t), vertex_buffer(mesh), face_buffer(t)}) unit.buffers.push_back(std::move(b));
  unit.surfaces.push_back(entry_surface(mesh, t));
}

std::uint64_t tetrahedra_bytes(const MeshField& mesh) {
  std::uint64_t tetrahedra = 0;
  for (const CellShape s : mesh.shape) tetrahedra += info_of(s).corners == 4 ? 1 : info_of(s).corners == 8 ? 6 : 3;
  return tetrahedra * 64 + mesh.point.size() * 48;
}

std::vector<double> slope_rows(const MeshField& mesh) {
  const Tetrahedra& t = tetrahedra_in(mesh);
  const bool cells = mesh.gradient == MeshGradient::cell;
  const std::vector<Vector3> g =
      cells ? cell_gradients(mesh) : vertex_gradients(mesh, mesh.gradient == MeshGradient::vertex_inverse_distance);
  const std::size_t count = cells ? t.vertex.size() : g.size();
  std::vector<double> rows;
  rows.reserve(4 * count);
  for (std::size_t j = 0; j < count; ++j) {
    const Vector3& x = g[cells && !t.cell.empty() ? t.cell[j] : j];
    rows.insert(rows.end(), {x[0] / mesh.slope, x[1] / mesh.slope, x[2] / mesh.slope, 0.0});
  }
  return rows;
}

}  // namespace dvrlab
