#include "framework/scene/cells.h"

#include "framework/interfaces/error.h"
#include "framework/scene/buffers.h"

namespace dvrlab {

bool samples_cells(const ResolvedCase& c) { return c.sampling.type == "cells"; }

void check_cells(const ResolvedCase& c) {
  if (samples_cells(c) && c.top.text("precision") != "fp64")
    throw InputError(
        "sampling.type: \"cells\" is there for truth and walks in double only; set precision to \"fp64\" "
        "(backend cpu), or use \"uniform\"");
}

void add_cells(const ResolvedCase& c, const Field& field, AlongRay along, const std::string& sampler,
               const OccupiedBins& occupied, KernelUnit& unit) {
  if (along == AlongRay::none)
    throw InputError("sampling.type: sampler \"" + sampler +
                     "\" does not say that its values are continuous in cells or given by a formula; use \"uniform\"");
  const double tolerance = c.sampling.parameters.number("tolerance");
  const double range = field.stored_max - field.stored_min;
  unit.uniforms.insert(
      unit.uniforms.end(),
      {Uniform::constant_integer("frame_cells", along == AlongRay::lattice ? 1 : 2),
       Uniform::real("frame_cells_tolerance", tolerance * (range > 0 ? range : 1.0)),
       Uniform::real("frame_cells_light", tolerance), Uniform::real("frame_cells_panel", field.voxel)});
  std::vector<int> sum = occupied.sums();
  const std::uint64_t count = sum.size();
  unit.buffers.push_back(make_buffer("frame_cells_occupied_sum", Element::i32, std::move(sum), count));
}

}  // namespace dvrlab
