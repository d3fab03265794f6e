#include <cstdio>

#include "framework/app/cli_model.h"
#include "framework/app/help_text.h"
#include "framework/app/verbs.h"
#include "framework/config/words.h"
#include "framework/interfaces/error.h"
#include "framework/plugin/registry.h"
#include "framework/report/pretty_json.h"

namespace dvrlab {

int help_verb(const Options& o) {
  const ProgramModel program = program_model();
  if (!o.name.empty() && program.find(o.name) == nullptr)
    throw InputError("help: unknown verb '" + o.name + "'" + did_you_mean(o.name, program.verb_names()) +
                     "; verbs: " + join_words(program.verb_names()));
  if (o.json) {
    std::printf("%s\n", pretty_json(model_json(program)).c_str());
  } else {
    std::fputs(o.name.empty() ? overview(program).c_str() : verb_help(program, o.name).c_str(), stdout);
  }
  return 0;
}

}  // namespace dvrlab
