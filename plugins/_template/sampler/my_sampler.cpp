// The `my_sampler` sampler: the nearest voxel of a grid, without interpolation. A config chooses it by its section
// `sampler`.
#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"

namespace dvrlab::my_sampler {
namespace {

constexpr Element element_of[] = {Element::u8, Element::i8, Element::u16, Element::i16, Element::f32};  // of VoxelType

class MySampler : public SamplerPlugin {
 public:
  // Names begin with the plugin's; the kernel reads them.
  KernelUnit bind(const Field& field) const override {
    const auto* grid = dynamic_cast<const GridField*>(&field);
    if (grid == nullptr) throw InputError("sampler.type: my_sampler reads voxel grids; this is " + field.source);
    KernelUnit unit;
    unit.uniforms = {Uniform::integer("my_sampler_nx", grid->dims[0]), Uniform::integer("my_sampler_ny", grid->dims[1]),
                     Uniform::integer("my_sampler_nz", grid->dims[2])};
    // Index -> world for gradients: rows of the inverse transposed linear part. Normals follow the physical value.
    const Affine inverse = grid->to_world.inverse();
    const double sign = grid->slope < 0 ? -1.0 : 1.0;
    const char* names[] = {"my_sampler_gradient_x", "my_sampler_gradient_y", "my_sampler_gradient_z"};
    for (std::size_t r = 0; r < 3; ++r)
      unit.uniforms.push_back(
          Uniform::vector(names[r], sign * inverse.m[r], sign * inverse.m[3 + r], sign * inverse.m[6 + r]));
    const Element element = element_of[static_cast<std::size_t>(grid->type)];
    unit.buffers = {Buffer{"my_sampler_voxels", element, grid->voxels, grid->count()}};
    return unit;
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("sampler", "my_sampler", "0.1", MySampler, "the nearest voxel of a grid, without interpolation", "")

}  // namespace dvrlab::my_sampler
