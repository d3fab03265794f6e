// Lights and local shading of a case, as the shading kernel reads them.
#pragma once

#include "framework/config/resolved_case.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/illumination.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

/// The lights of the config and what its illumination passes make of them. `linear`: light colours are decoded
/// from sRGB. Throws InputError for a light without direction.
LocalShading local_shading(const ResolvedCase& c, const Registry& registry, const Field& field, bool linear);

/// Adds frame_shading, frame_ambient ..., frame_light. `value_per_stored` = |slope|: gradients are of stored values.
void add_shading(const LocalShading& shading, double value_per_stored, KernelUnit& unit);

}  // namespace dvrlab
