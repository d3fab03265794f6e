// The `mesh` sampler: binds a mesh of 4-node tetrahedra to its kernel.
#include "framework/interfaces/mesh.h"

#include "framework/interfaces/error.h"
#include "framework/scene/buffers.h"
#include "framework/scene/mesh/tetrahedra_unit.h"

namespace dvrlab::mesh {
namespace {

class Mesh : public SamplerPlugin {
 public:
  std::uint64_t bytes_needed(const Field& field, const ParameterSet&) const override {
    const auto* mesh = dynamic_cast<const MeshField*>(&field);
    if (mesh == nullptr) return 0;
    const std::uint64_t slopes = mesh->gradient == MeshGradient::cell ? mesh->cells() : mesh->point.size();
    return tetrahedra_bytes(*mesh) + slopes * 48;
  }

  KernelUnit bind(const Field& field) const override {
    const auto* mesh = dynamic_cast<const MeshField*>(&field);
    if (mesh == nullptr) throw InputError("sampler mesh: " + field.source + " is no mesh");
    for (const CellShape s : mesh->shape)
      if (!info_of(s).linear())
        throw InputError("sampler mesh: " + mesh->source + " has cells of the shape " + info_of(s).name +
                         ", in which the scalar is not linear; leave out the section sampler");
    KernelUnit unit;
    unit.uniforms = {Uniform::constant_integer("mesh_gradients", mesh->gradient == MeshGradient::cell ? 0 : 1)};
    add_tetrahedra(*mesh, unit);
    unit.buffers.push_back(vec4_buffer("mesh_slope", slope_rows(*mesh)));
    return unit;
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("sampler", "mesh", "1.0", Mesh,
                    "walks through a mesh of tetrahedra, from face to face: every cell is one segment",
                    "P. Williams and N. Max, A Volume Density Optical Model, Workshop on Volume Visualization 1992, "
                    "doi:10.1145/147130.147151")

}  // namespace dvrlab::mesh
