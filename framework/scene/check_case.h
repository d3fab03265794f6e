// What can be refused without reading the data.
#pragma once

#include "framework/config/problems.h"
#include "framework/config/resolved_case.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

/// An estimator that cannot integrate a term of the model, a direction that is 0, ...: each reason is added to
/// `problems` and begins with its key.
void check_case(const ResolvedCase& c, const Registry& registry, Problems& problems);

}  // namespace dvrlab
