#include "framework/app/completion.h"

namespace dvrlab {

Completes completes(const OptionModel& o) {
  if (!o.choices.empty() || o.value == "VERB") return Completes::words;
  if (o.value == "FILE" || o.value == "A" || o.value == "B") return Completes::file;
  if (o.value == "DIR") return Completes::folder;
  if (o.value == "KIND") return Completes::kinds;
  if (o.value == "TYPE") return Completes::types;
  return Completes::nothing;
}

std::vector<std::string> words_of(const ProgramModel& program, const OptionModel& option) {
  return option.value == "VERB" ? program.verb_names() : option.choices;
}

}  // namespace dvrlab
