// Completion scripts: verbs, options, files, and the names of types, which the scripts ask the program for.
#pragma once

#include <string>

#include "framework/app/cli_model.h"

namespace dvrlab {

/// What may stand where a value is asked for.
enum class Completes { nothing, file, folder, words, kinds, types };
Completes completes(const OptionModel& option);
/// For `words`: the choices, or the verbs.
std::vector<std::string> words_of(const ProgramModel& program, const OptionModel& option);

std::string bash_completion(const ProgramModel& program);
std::string zsh_completion(const ProgramModel& program);
std::string fish_completion(const ProgramModel& program);

}  // namespace dvrlab
