// The `mesh` sampler: binds an unstructured mesh to its kernel, as tetrahedra that share faces.
#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh.h"
#include "framework/scene/buffers.h"
#include "framework/scene/mesh/mesh_gradients.h"
#include "framework/scene/mesh/tetrahedra.h"

namespace dvrlab::mesh {
namespace {

/// World to sampler coordinates: a shift and one factor (finish_mesh).
Vector3 sampler_point(const MeshField& mesh, const Vector3& p) {
  Vector3 x;
  for (std::size_t a = 0; a < 3; ++a) x[a] = (p[a] - mesh.to_world.t[a]) / mesh.to_world.m[0];
  return x;
}

Buffer vertex_buffer(const MeshField& mesh) {
  std::vector<double> rows;
  rows.reserve(4 * mesh.point.size());
  for (std::size_t p = 0; p < mesh.point.size(); ++p) {
    const Vector3 x = sampler_point(mesh, mesh.point[p]);
    rows.insert(rows.end(), {x[0], x[1], x[2], (mesh.value[p] - mesh.intercept) / mesh.slope});
  }
  return vec4_buffer("mesh_vertex", std::move(rows));
}

Buffer tetrahedron_buffer(const Tetrahedra& t) {
  std::vector<std::int32_t> rows;
  rows.reserve(8 * t.vertex.size());
  for (std::size_t j = 0; j < t.vertex.size(); ++j) {
    rows.insert(rows.end(), t.vertex[j].begin(), t.vertex[j].end());
    rows.insert(rows.end(), t.neighbour[j].begin(), t.neighbour[j].end());
  }
  return make_buffer("mesh_tetrahedron", Element::ivec4, std::move(rows), 2 * t.vertex.size());
}

Buffer face_buffer(const Tetrahedra& t) {
  std::vector<std::int32_t> rows;
  for (const Tetrahedra::BoundaryFace& f : t.boundary)
    rows.insert(rows.end(), {f.vertex[0], f.vertex[1], f.vertex[2], f.tetrahedron});
  return make_buffer("mesh_face", Element::ivec4, std::move(rows), t.boundary.size());
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
  return {"mesh_entry", std::move(faces)};
}

/// Per tetrahedron or per vertex, in stored values.
Buffer slope_buffer(const MeshField& mesh, const Tetrahedra& t) {
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
  return vec4_buffer("mesh_slope", std::move(rows));
}

class Mesh : public SamplerPlugin {
 public:
  std::uint64_t bytes_needed(const Field& field) const override {
    const auto* mesh = dynamic_cast<const MeshField*>(&field);
    if (mesh == nullptr) return 0;
    // Tetrahedra with neighbours, here and for kernels; vertices and gradients in fp32 and fp64.
    std::uint64_t tetrahedra = 0;
    for (const CellShape s : mesh->shape) tetrahedra += info_of(s).corners == 4 ? 1 : info_of(s).corners == 8 ? 6 : 3;
    const std::uint64_t slopes = mesh->gradient == MeshGradient::cell ? tetrahedra : mesh->point.size();
    return tetrahedra * 64 + (mesh->point.size() + slopes) * 48;
  }

  KernelUnit bind(const Field& field) const override {
    const auto* mesh = dynamic_cast<const MeshField*>(&field);
    if (mesh == nullptr) throw InputError("sampler mesh: " + field.source + " is no mesh");
    for (const CellShape s : mesh->shape)
      if (!info_of(s).linear())
        throw NotSupported("sampler mesh: " + mesh->source + " has " + info_of(s).name + " cells");
    const Tetrahedra& t = tetrahedra_in(*mesh);
    KernelUnit unit;
    unit.uniforms = {Uniform::constant_integer("mesh_gradients", mesh->gradient == MeshGradient::cell ? 0 : 1)};
    unit.buffers = {tetrahedron_buffer(t), vertex_buffer(*mesh), slope_buffer(*mesh, t), face_buffer(t)};
    unit.surfaces = {entry_surface(*mesh, t)};
    return unit;
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("sampler", "mesh", "1.0", Mesh,
                    "walks through the cells of an unstructured mesh, from face to face",
                    "P. Williams and N. Max, A Volume Density Optical Model, Workshop on Volume Visualization 1992, "
                    "doi:10.1145/147130.147151")

}  // namespace dvrlab::mesh
