// The manual page, in man(7).
#pragma once

#include <string>

#include "framework/app/cli_model.h"

namespace dvrlab {

std::string man_page(const ProgramModel& program);

}  // namespace dvrlab
