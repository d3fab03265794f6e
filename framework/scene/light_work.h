// The light volume of a case: what its illumination pass plans, with everything that the stages read.
#pragma once

#include <memory>

#include "framework/config/resolved_case.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/illumination.h"
#include "framework/interfaces/medium.h"
#include "framework/plugin/registry.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

/// True if one of the case's passes fills a light volume.
bool fills_light_volume(const ResolvedCase& c, const Registry& registry);

/// Nothing when no pass fills a light volume. `blocks`: of the field, where it lies in such. `sampler` is left open.
/// `shading` holds the lights; `value_per_stored`, `value_of_zero`: stored values to those of the transfer functions.
/// Throws InputError for a light that a pass cannot use.
std::shared_ptr<LightWork> light_work(const ResolvedCase& c, const Registry& registry, const Field& field,
                                      const Medium& medium, const MediumTableOptions& options,
                                      const LocalShading& shading, double value_per_stored, double value_of_zero,
                                      std::shared_ptr<const BlockedField> blocks);

/// Adds frame_lit, frame_light_*, medium_lit_sum over the bins of the medium's table; `occupied`: what segments may
/// contribute, as empty-space skipping sees it. The volume itself comes with the frame.
void add_light_volume(const LightWork* work, const OccupiedBins& occupied, const MediumTableOptions& options,
                      KernelUnit& unit);

}  // namespace dvrlab
