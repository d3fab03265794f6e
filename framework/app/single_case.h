// The one case of a config without axes, or of a data file, for the verbs that work on one.
#pragma once

#include "framework/app/verbs.h"
#include "framework/config/experiment.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

/// Throws InputError when the config asks for more than one case.
PlannedCase single_case(const Options& options, const Registry& registry);

}  // namespace dvrlab
