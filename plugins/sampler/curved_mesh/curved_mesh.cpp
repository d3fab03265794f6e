// The `curved_mesh` sampler: binds a mesh with cells in which the scalar is not linear to its kernel.
#include <algorithm>
#include <cmath>

#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh.h"
#include "framework/scene/buffers.h"
#include "framework/scene/mesh/elements.h"
#include "framework/scene/mesh/mesh_gradients.h"
#include "framework/scene/mesh/tetrahedra.h"
#include "framework/scene/mesh/tetrahedra_unit.h"

namespace dvrlab::curved_mesh {
namespace {

/// Elements: the cells that are no 4-node tetrahedra, in the mesh's order.
std::vector<std::uint64_t> elements_of(const MeshField& mesh) {
  std::vector<std::uint64_t> list;
  for (std::uint64_t c = 0; c < mesh.cells(); ++c)
    if (!info_of(mesh.shape[c]).linear()) list.push_back(c);
  return list;
}

int terms_of(const MeshField& mesh) {
  for (const CellShape s : mesh.shape)
    if (!info_of(s).edges.empty()) return element_terms;
  return linear_element_terms;
}

/// Of tetrahedra: the element that each is a part of.
Buffer cell_buffer(const MeshField& mesh, const std::vector<std::uint64_t>& elements) {
  const Tetrahedra& t = tetrahedra_in(mesh);
  std::vector<std::int32_t> of_cell(mesh.cells(), -1), rows(t.vertex.size());
  for (std::size_t e = 0; e < elements.size(); ++e) of_cell[elements[e]] = static_cast<std::int32_t>(e);
  for (std::size_t j = 0; j < rows.size(); ++j) rows[j] = of_cell[t.cell.empty() ? j : t.cell[j]];
  const std::uint64_t count = rows.size();
  return make_buffer("curved_mesh_cell", Element::i32, std::move(rows), count);
}

/// A polynomial in sampler coordinates and stored values.
Element4 stored(const MeshField& mesh, Element4 e) {
  for (std::size_t k = 0; k < element_terms; ++k) {
    for (std::size_t a = 0; a < 3; ++a) e[k][a] = (e[k][a] - (k == 0 ? mesh.to_world.t[a] : 0)) / mesh.to_world.m[0];
    e[k][3] = (e[k][3] - (k == 0 ? mesh.intercept : 0)) / mesh.slope;
  }
  return e;
}

/// The place is a linear map of the reference coordinates, up to rounding.
bool distorted(const Element4& e) {
  double bent = 0, size = 0;
  for (std::size_t k = 1; k < element_terms; ++k) {
    const bool linear = k == 1 || k == 2 || k == 4;
    for (std::size_t a = 0; a < 3; ++a) (linear ? size : bent) = std::max(linear ? size : bent, std::abs(e[k][a]));
  }
  return bent > 1e-9 * size;
}

/// Coefficients of the gradients of an element's corners, by the functions of the corners alone.
void add_corner_gradients(const MeshField& mesh, std::uint64_t cell, const std::vector<Vector3>& of_vertex,
                          std::vector<double>& rows) {
  MeshField corners;  // one cell, whose "places" are the gradients
  const CellShape shapes[] = {CellShape::tetrahedron, CellShape::pyramid, CellShape::wedge, CellShape::hexahedron};
  const int n = info_of(mesh.shape[cell]).corners;
  std::vector<std::uint32_t> nodes;
  for (int k = 0; k < n; ++k) {
    corners.point.push_back(of_vertex[mesh.nodes_of(cell)[static_cast<std::size_t>(k)]]);
    corners.value.push_back(0);
    nodes.push_back(static_cast<std::uint32_t>(k));
  }
  corners.add_cell(n == 4 ? shapes[0] : n == 5 ? shapes[1] : n == 6 ? shapes[2] : shapes[3], nodes);
  const Element4 e = element_of(corners, 0);
  for (std::size_t k = 0; k < linear_element_terms; ++k)
    rows.insert(rows.end(), {e[k][0] / mesh.slope, e[k][1] / mesh.slope, e[k][2] / mesh.slope, 0.0});
}

class CurvedMesh : public SamplerPlugin {
 public:
  std::uint64_t bytes_needed(const Field& field, const ParameterSet&) const override {
    const auto* mesh = dynamic_cast<const MeshField*>(&field);
    if (mesh == nullptr) return 0;
    const std::uint64_t terms = static_cast<std::uint64_t>(terms_of(*mesh)) + linear_element_terms + 1;
    return tetrahedra_bytes(*mesh) + mesh->cells() * (terms * 48 + 24) + mesh->point.size() * 48;
  }

  KernelUnit bind(const Field& field) const override {
    const auto* mesh = dynamic_cast<const MeshField*>(&field);
    if (mesh == nullptr) throw InputError("sampler curved_mesh: " + field.source + " is no mesh");
    const std::vector<std::uint64_t> elements = elements_of(*mesh);
    const int terms = terms_of(*mesh);
    const bool cells = mesh->gradient == MeshGradient::cell;
    const std::vector<Vector3> of_vertex =
        cells ? std::vector<Vector3>()
              : vertex_gradients(*mesh, mesh->gradient == MeshGradient::vertex_inverse_distance);
    std::vector<double> rows, centres, bends;
    bool any_distorted = false;
    for (const std::uint64_t c : elements) {
      const Element4 e = stored(*mesh, element_of(*mesh, c));
      any_distorted = any_distorted || distorted(e);
      for (int k = 0; k < terms; ++k)
        rows.insert(rows.end(), e[static_cast<std::size_t>(k)].begin(), e[static_cast<std::size_t>(k)].end());
      const Vector3 middle = reference_centre(mesh->shape[c]);
      centres.insert(centres.end(), {middle[0], middle[1], middle[2], 0.0});
      if (!cells) add_corner_gradients(*mesh, c, of_vertex, bends);
    }
    // One table: the bindings of a GPU are few.
    const auto entries = [&] { return static_cast<int>(rows.size() / 4); };
    const auto append = [&](const std::vector<double>& more) { rows.insert(rows.end(), more.begin(), more.end()); };
    const int centres_at = entries();
    append(centres);
    const int bends_at = entries();
    append(bends);
    const int slopes_at = entries();
    append(slope_rows(*mesh));
    KernelUnit unit;
    unit.uniforms = {Uniform::constant_integer("curved_mesh_gradients", cells ? 0 : 1),
                     Uniform::constant_integer("curved_mesh_terms", terms),
                     Uniform::constant_integer("curved_mesh_distorted", any_distorted ? 1 : 0),
                     Uniform::real("curved_mesh_tolerance", mesh->tolerance),
                     Uniform::real("curved_mesh_inv_size", 1 / mesh->to_world.m[0]),
                     Uniform::integer("curved_mesh_centres", centres_at),
                     Uniform::integer("curved_mesh_bends", bends_at),
                     Uniform::integer("curved_mesh_slopes", slopes_at)};
    add_tetrahedra(*mesh, unit);
    unit.buffers.push_back(cell_buffer(*mesh, elements));
    unit.buffers.push_back(vec4_buffer("curved_mesh_table", std::move(rows)));
    return unit;
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN(
    "sampler", "curved_mesh", "1.0", CurvedMesh,
    "walks through a mesh of hexahedra, wedges, pyramids, tetrahedra and quadratic cells: each in segments "
    "that are linear to a tolerance",
    "P. Williams and N. Max, A Volume Density Optical Model, Workshop on Volume Visualization 1992, appendix, "
    "doi:10.1145/147130.147151")

}  // namespace dvrlab::curved_mesh
