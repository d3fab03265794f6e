// Part of plan_experiment: the config of one planned case is resolved, and checked as far as that is possible without
// reading its data.
#pragma once

#include "framework/config/experiment.h"
#include "framework/config/problems.h"

namespace dvrlab {

/// Fills c.resolved. What is wrong with the case is added to `problems`: views that are still open, what resolve_case
/// and check_case refuse, metrics that are listed twice, a data file that is missing though it must be there.
void resolve_planned(const ConfigTree& tree, const std::string& base_folder, const Registry& registry, PlannedCase& c,
                     Problems& problems);

}  // namespace dvrlab
