// What is wrong with a command line that CLI11 refuses, in one sentence with the nearest name.
#pragma once

#include <string>
#include <vector>

#include "framework/app/cli_model.h"

namespace dvrlab {

/// `arguments` without the program's name. `reason`: what CLI11 says.
std::string usage_error(const ProgramModel& program, const std::vector<std::string>& arguments,
                        const std::string& reason);

}  // namespace dvrlab
