#include "framework/scene/sampling.h"

#include <algorithm>
#include <cstdio>

#include "framework/interfaces/blocks.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh.h"
#include "framework/interfaces/transfer_function.h"
#include "framework/scene/buffers.h"
#include "framework/scene/cells.h"
#include "framework/scene/macrocells.h"
#include "framework/scene/vector.h"

namespace dvrlab {

bool samples_faces(const ResolvedCase& c) { return c.sampling.type == "faces"; }

bool skips(const ResolvedCase& c) { return c.sampling.type == "uniform" && c.sampling.parameters.boolean("skipping"); }

double step_of(const ResolvedCase& c, const Field& field, std::vector<std::string>& notes) {
  if (samples_cells(c)) return field.voxel;
  const ParameterSet& p = c.sampling.parameters;
  if (p.text("unit") != "voxel") return p.number("step");
  const double step = p.number("step") * field.voxel;
  char text[120];
  std::snprintf(text, sizeof(text), "sampling.step: %g voxel = %.9g world units (%.9g)", p.number("step"), step,
                field.voxel);
  notes.emplace_back(text);
  return step;
}

namespace {

/// False where every segment is shorter than the step and stays whole, which spares the marching of parts. A cell with
/// curved faces may be longer than its corners are apart.
bool cuts_segments(const ResolvedCase& c, const Field& field, double step) {
  constexpr double bulge = 4;
  const auto* mesh = dynamic_cast<const MeshField*>(&field);
  return samples_faces(c) && (mesh == nullptr || step < bulge * mesh->longest);
}

}  // namespace

void add_sampling(const ResolvedCase& c, const Field& field, double step, KernelUnit& unit) {
  const ParameterSet& p = c.sampling.parameters;
  const double jitter = c.sampling.type == "uniform" ? p.number("jitter") : 0.0;
  const auto background = c.image.vector3("background");
  const bool linear = c.image.text("space") == "linear";
  const auto decode = [&](double x) { return linear ? display_to_linear(x) : x; };
  unit.uniforms.insert(
      unit.uniforms.end(),
      {Uniform::real("frame_step", step), Uniform::real("frame_inv_step", 1.0 / step),
       Uniform::constant_integer("frame_parts", cuts_segments(c, field, step) ? 1 : 0),
       Uniform::real("frame_parts_per_length", 1.0 / step),
       Uniform::constant_integer("frame_jitter_on", jitter > 0 ? 1 : 0), Uniform::real("frame_jitter", jitter),
       // The same 32 bits: the hash takes the seed as they are.
       Uniform::integer("frame_seed", static_cast<int>(static_cast<std::uint32_t>(c.top.integer("seed")))),
       Uniform::real("frame_termination", p.number("termination")),
       Uniform::vector("frame_background", decode(background[0]), decode(background[1]), decode(background[2]))});
}

namespace {
// Whole numbers of segments stay exact in fp32 far beyond this; software GPUs cut a loop after 65535 rounds,
// and the first samples of a ray take rounds of their own.
constexpr double most_segments = 65500;
}  // namespace

// A ray passes at most the diagonal of the domain, and what the camera allows.
void refuse_tiny_step(const Field& field, double step, const KernelUnit& frame) {
  const auto number = [&](const char* name) {
    for (const Uniform& u : frame.uniforms)
      if (u.name == name) return u.f[0];
    return 0.0;
  };
  const double diagonal = length(field.to_world.vector(minus(field.hi, field.lo)));
  const double segments = std::min(diagonal, number("frame_t1") - number("frame_t0")) / step;
  if (segments <= most_segments) return;
  char text[200];
  std::snprintf(text, sizeof(text),
                "sampling.step: %.6g world units make up to %.3g segments on a ray; at most %g are marched, "
                "so use a step of at least %.6g world units",
                step, segments, most_segments, step * segments / most_segments);
  throw InputError(text);
}

// Skipping only concerns grids; without it the kernel's binding holds one macrocell that is never empty.
void add_skipping(bool wanted, const Field& field, const BlockedField* blocks, const OccupiedBins& occupied,
                  KernelUnit& unit) {
  const auto* grid = dynamic_cast<const GridField*>(&field);
  std::vector<std::uint8_t> distance(4, 0);
  std::array<int, 3> dims{1, 1, 1};
  const bool skip = wanted && grid != nullptr;
  if (skip) {
    const auto cells =
        blocks != nullptr ? std::static_pointer_cast<const Macrocells>(blocks->macrocells) : macrocells_of(*grid);
    dims = cells->dims;
    distance = empty_distance(*cells, occupied);
  }
  unit.uniforms.insert(
      unit.uniforms.end(),
      {Uniform::constant_integer("frame_skip", skip ? 1 : 0), Uniform::integer("frame_skip_nx", dims[0]),
       Uniform::integer("frame_skip_ny", dims[1]), Uniform::integer("frame_skip_nz", dims[2])});
  const std::uint64_t count = distance.size();
  unit.buffers.push_back(make_buffer("frame_skip_distance", Element::u8, std::move(distance), count));
}

}  // namespace dvrlab
