// Where a case takes its samples, as the kernels of steps and walks read it.
#pragma once

#include <string>
#include <vector>

#include "framework/config/resolved_case.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/kernel_unit.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

/// True where empty space may be skipped: it concerns samples at equal distances only.
bool skips(const ResolvedCase& c);
/// Segments end at the faces of cells, and are cut at a step.
bool samples_faces(const ResolvedCase& c);

/// The step in world units; a conversion from voxels is added to `notes`. Where segments follow the cells of the data,
/// estimators are told a voxel.
double step_of(const ResolvedCase& c, const Field& field, std::vector<std::string>& notes);

/// Adds frame_step ... frame_background.
void add_sampling(const ResolvedCase& c, const Field& field, double step, KernelUnit& unit);

/// Throws InputError when a ray could have more segments than are marched. `frame` has the camera's uniforms.
void refuse_tiny_step(const Field& field, double step, const KernelUnit& frame);

/// Adds frame_skip ... frame_skip_distance. `blocks`: what the field lies in; their values are those that count.
void add_skipping(bool wanted, const Field& field, const BlockedField* blocks, const OccupiedBins& occupied,
                  KernelUnit& unit);

}  // namespace dvrlab
