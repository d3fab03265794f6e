// The `grid` sampler: binds a voxel grid to its kernel.
#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"

namespace {
using namespace dvrlab;

Element element_of(VoxelType t) {
  switch (t) {
    case VoxelType::u8:
      return Element::u8;
    case VoxelType::i8:
      return Element::i8;
    case VoxelType::u16:
      return Element::u16;
    case VoxelType::i16:
      return Element::i16;
    case VoxelType::f32:
      return Element::f32;
  }
  return Element::f32;
}

class Grid : public SamplerPlugin {
 public:
  AlongRay along_ray() const override { return AlongRay::lattice; }
  KernelUnit bind(const Field& field) const override {
    const auto* grid = dynamic_cast<const GridField*>(&field);
    if (grid == nullptr) throw InputError("sampler grid: " + field.source + " is no voxel grid");
    if (grid->count() > (std::uint64_t{1} << 32))
      throw NotSupported("sampler grid: " + std::to_string(grid->count()) +
                         " voxels; kernels address at most 2^32 (4294967296) voxels");
    KernelUnit unit;
    const auto& n = grid->dims;
    unit.uniforms = {Uniform::integer("grid_nx", n[0]), Uniform::integer("grid_ny", n[1]),
                     Uniform::integer("grid_nz", n[2])};
    // The gradient in world space is the inverse transposed of the linear part times the gradient in index space. With
    // a negative slope the physical value falls where the stored one grows: normals follow the physical value.
    const Affine inverse = grid->to_world.inverse();
    const double sign = grid->slope < 0 ? -1.0 : 1.0;
    const char* names[3] = {"grid_gradient_x", "grid_gradient_y", "grid_gradient_z"};
    for (std::size_t r = 0; r < 3; ++r)
      unit.uniforms.push_back(
          Uniform::vector(names[r], sign * inverse.m[r], sign * inverse.m[3 + r], sign * inverse.m[6 + r]));
    unit.buffers = {Buffer{"grid_voxels", element_of(grid->type), grid->voxels, grid->count()}};
    return unit;
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("sampler", "grid", "1.0", Grid, "trilinear interpolation of a voxel grid in fp32, exact gradient",
                    "")
