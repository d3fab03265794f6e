// The table builder's modules, one per instruction set, chosen at run time.
#pragma once

#include <string>

#include "plugins/estimator/preintegrated/table_module.h"

namespace dvrlab::preintegrated {

/// <folder>/table.<isa>.so, opened once and for good. `isa` is "scalar", "sse4.2", "avx2", "avx512" or "auto", the
/// widest that this processor has. Throws NotSupported when the processor lacks the set, std::runtime_error when the
/// library is missing or of another ABI: the build is broken, not the config.
const dvr_table_module& table_module(const std::string& folder, const std::string& isa);

}  // namespace dvrlab::preintegrated
