// The config language as a JSON Schema, for editors: derived from the declarations of the framework and of the plugins.
#pragma once

#include <nlohmann/json.hpp>

#include "framework/interfaces/parameter.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

/// The value of one key (draft-07): type, range, choices, default, and its unit and sentence as documentation.
nlohmann::ordered_json value_schema(const Parameter& parameter);

/// The JSON Schema (draft-07) of a whole config: every section, the type chooses the keys; key paths in axes, reference
/// and `where`. What it refuses, `dvrlab validate` refuses too; what needs files, the data or two sections at once only
/// the latter sees. Keys that are missing are reported only where no include and no axis can bring them.
nlohmann::ordered_json config_schema(const Registry& registry);

}  // namespace dvrlab
