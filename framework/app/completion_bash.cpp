#include "framework/app/completion.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

/// The command that fills COMPREPLY.
std::string fill(const ProgramModel& program, const OptionModel& o) {
  switch (completes(o)) {
    case Completes::nothing:
      return ":";
    case Completes::file:
      return "_dvrlab_paths -f";
    case Completes::folder:
      return "_dvrlab_paths -d";
    case Completes::words:
      return "_dvrlab_words '" + join_words(words_of(program, o), " ") + "'";
    case Completes::kinds:
      return "_dvrlab_words \"$(\"$program\" completion kinds 2>/dev/null)\"";
    case Completes::types:
      return "_dvrlab_words \"$(\"$program\" completion types 2>/dev/null)\"";
  }
  return ":";
}

/// "-o|--output"
std::string pattern(const std::string& verb, const OptionModel& o) {
  std::vector<std::string> names;
  for (const std::string& name : o.names) names.push_back(verb + ":" + name);
  return join_words(names, " | ");
}

std::string names_of(const std::vector<OptionModel>& options) {
  std::vector<std::string> names;
  for (const OptionModel& o : options) names.insert(names.end(), o.names.begin(), o.names.end());
  return join_words(names, " ");
}

}  // namespace

std::string bash_completion(const ProgramModel& program) {
  std::string after_option, positions, options, takes_value;
  for (const OptionModel& o : program.options) {
    if (o.value.empty()) continue;
    after_option += "    " + pattern("*", o) + ") " + fill(program, o) + "; return ;;\n";
    takes_value += (takes_value.empty() ? "" : " | ") + join_words(o.names, " | ");
  }
  for (const VerbModel& v : program.verbs) {
    int place = 0;
    for (const OptionModel& o : v.options) {
      if (o.argument()) {
        positions += "    " + v.name + ":" + std::to_string(place++) + ") " + fill(program, o) + " ;;\n";
      } else if (!o.value.empty()) {
        after_option += "    " + pattern(v.name, o) + ") " + fill(program, o) + "; return ;;\n";
        takes_value += " | " + join_words(o.names, " | ");
      }
    }
    options += "    " + v.name + ") _dvrlab_words '" + names_of(v.options) + " " +
               names_of(program.general_options(v)) + "' ;;\n";
  }
  return R"(# bash completion for dvrlab, printed by `dvrlab completion bash`
_dvrlab_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }
_dvrlab_paths() {
  mapfile -t COMPREPLY < <(compgen "$1" -- "$word")
  compopt -o filenames 2>/dev/null
}
_dvrlab() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} verb= place=0 i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${COMP_WORDS[i]} in
      )" +
         takes_value +
         R"() ((i++)) ;;
      -*) ;;
      *) if [ -z "$verb" ]; then verb=${COMP_WORDS[i]}; else ((place++)); fi ;;
    esac
  done
  case $verb:$before in
)" + after_option +
         R"(  esac
  if [ -z "$verb" ]; then
    case $word in
      -*) _dvrlab_words ')" +
         names_of(program.options) + R"(' ;;
      *) _dvrlab_words ')" +
         join_words(program.verb_names(), " ") + R"(' ;;
    esac
    return
  fi
  if [[ $word == -* ]]; then
    case $verb in
)" + options +
         R"(    esac
    return
  fi
  case $verb:$place in
)" + positions +
         R"(  esac
}
complete -F _dvrlab dvrlab
)";
}

}  // namespace dvrlab
