// The help as people read it.
#pragma once

#include <string>

#include "framework/app/cli_model.h"

namespace dvrlab {

/// All verbs by group, general options, exit codes.
std::string overview(const ProgramModel& program);

/// `verb` must be one of the program's.
std::string verb_help(const ProgramModel& program, const std::string& verb);

/// "-o, --output FILE", "FILE".
std::string option_heading(const OptionModel& option);

/// The description with what is required, repeated, chosen from or the default.
std::string option_words(const OptionModel& option);

}  // namespace dvrlab
