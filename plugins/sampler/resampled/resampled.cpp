// The `resampled` sampler: a mesh on a grid, as passes of light volumes ask it.
#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh.h"
#include "framework/scene/buffers.h"
#include "framework/scene/mesh/resample.h"

namespace dvrlab::resampled {
namespace {

class Resampled : public SamplerPlugin {
 public:
  KernelUnit bind(const Field& field) const override {
    throw InputError(
        "sampler.type: \"resampled\" is chosen by passes of light volumes, whose `resolution` is its grid; " +
        field.source + " has a sampler of its own, leave out the section sampler");
  }
  KernelUnit bind_to(const Field& field, const std::array<int, 3>& dims) const override {
    const auto* mesh = dynamic_cast<const MeshField*>(&field);
    if (mesh == nullptr) throw InputError("sampler resampled: " + field.source + " is no mesh");
    const ResampledMesh r = resample(*mesh, dims);
    KernelUnit unit;
    Vector3 scale;
    for (std::size_t a = 0; a < 3; ++a) scale[a] = (dims[a] - 1) / (mesh->hi[a] - mesh->lo[a]);
    unit.uniforms = {Uniform::integer("resampled_nx", dims[0]), Uniform::integer("resampled_ny", dims[1]),
                     Uniform::integer("resampled_nz", dims[2]),
                     Uniform::vector("resampled_lo", mesh->lo[0], mesh->lo[1], mesh->lo[2]),
                     Uniform::vector("resampled_scale", scale[0], scale[1], scale[2])};
    unit.buffers = {real_buffer("resampled_value", {r.value.begin(), r.value.end()}),
                    real_buffer("resampled_inside", {r.inside.begin(), r.inside.end()})};
    return unit;
  }
};

}  // namespace

DVRLAB_PLUGIN_PLAIN("sampler", "resampled", "1.0", Resampled, "a mesh on a regular grid, for passes of light volumes",
                    "")

}  // namespace dvrlab::resampled
