#include "framework/app/completion.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

/// Inside single quotes, and inside the brackets and colons of _arguments.
std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result;
}

std::string action(const ProgramModel& program, const OptionModel& o) {
  switch (completes(o)) {
    case Completes::nothing:
      return " ";
    case Completes::file:
      return "_files";
    case Completes::folder:
      return "_files -/";
    case Completes::words:
      return "(" + join_words(words_of(program, o), " ") + ")";
    case Completes::kinds:
      return "($(_call_program kinds $words[1] completion kinds))";
    case Completes::types:
      return "($(_call_program types $words[1] completion types))";
  }
  return " ";
}

/// One specification of _arguments.
std::string spec(const ProgramModel& program, const OptionModel& o, int& place) {
  const std::string value = o.value.empty() ? "" : ":" + o.value + ":" + action(program, o);
  if (o.argument()) return " '" + std::to_string(++place) + value + "'";
  const std::string text = "[" + escaped(o.description) + "]" + value + "'";
  std::string specs;
  for (const std::string& name : o.names) {
    const std::string others = o.names.size() > 1 ? "(" + join_words(o.names, " ") + ")" : "";
    specs += " '" + (o.repeats ? "*" : others) + name + text;
  }
  return specs;
}

}  // namespace

std::string zsh_completion(const ProgramModel& program) {
  std::string verbs, cases, general;
  int none = 0;
  for (const OptionModel& o : program.options) general += spec(program, o, none);
  for (const VerbModel& v : program.verbs) {
    verbs += "    '" + v.name + ":" + escaped(v.summary) + "'\n";
    int place = 0;
    cases += "        " + v.name + ") _arguments";
    for (const OptionModel& o : v.options) cases += spec(program, o, place);
    for (const OptionModel& o : program.general_options(v)) cases += spec(program, o, place);
    cases += " ;;\n";
  }
  return R"(#compdef dvrlab
# zsh completion for dvrlab, printed by `dvrlab completion zsh`
_dvrlab() {
  local curcontext=$curcontext state line program=$words[1]
  local -a verbs
  verbs=(
)" + verbs +
         R"(  )
  _arguments -C)" +
         general + R"( '1:verb:->verb' '*::argument:->arguments'
  case $state in
    verb) _describe verb verbs ;;
    arguments)
      local verb=$words[1]
      words[1]=$program
      case $verb in
)" + cases +
         R"(      esac
      ;;
  esac
}
if [[ $zsh_eval_context[-1] == loadautofunc ]]; then _dvrlab "$@"; else compdef _dvrlab dvrlab; fi
)";
}

}  // namespace dvrlab
