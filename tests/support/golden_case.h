// Golden ray cases (golden/public.json beside the shared data) as configs. Their convention stands in the file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/reference.h"

namespace dvrlab::test {

/// The case of that id; null when the data are not there.
nlohmann::json golden_case(const std::string& id);

/// A config of one pixel: the case's data, optical model (nodes), light, background, and its ray in `segments` steps.
/// No estimator. Throws std::logic_error for a ray or a model that no config can say (mesh elements).
nlohmann::json golden_config(const nlohmann::json& golden_case, int segments);

/// The ids of all ray cases that golden_config knows.
std::vector<std::string> golden_rays();

/// Radiance and transmittance of a case, from its 16 printed digits.
RayIntegral golden_integral(const nlohmann::json& golden_case);

/// The ramp ray of length 1 through medium `name` of math.md table G: v = 0.0037 -> 0.9963, or back; no estimator.
nlohmann::json golden_medium_config(const std::string& name, int segments, bool backwards);

}  // namespace dvrlab::test
