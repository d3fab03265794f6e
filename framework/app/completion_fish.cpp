#include "framework/app/completion.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

std::string value_words(const ProgramModel& program, const OptionModel& o) {
  switch (completes(o)) {
    case Completes::nothing:
      return "";
    case Completes::file:
      return " -F";
    case Completes::folder:
      return " -a '(__fish_complete_directories (commandline -ct))'";
    case Completes::words:
      return " -a " + quoted(join_words(words_of(program, o), " "));
    case Completes::kinds:
      return " -a '(dvrlab completion kinds)'";
    case Completes::types:
      return " -a '(dvrlab completion types)'";
  }
  return "";
}

std::string line(const ProgramModel& program, const OptionModel& o, const std::string& condition) {
  std::string text = "complete -c dvrlab" + condition;
  for (const std::string& name : o.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!o.argument() && !o.value.empty()) text += " -r";
  text += value_words(program, o);
  return text + (o.argument() ? "" : " -d " + quoted(o.description)) + "\n";
}

}  // namespace

std::string fish_completion(const ProgramModel& program) {
  std::string text = "# fish completion for dvrlab, printed by `dvrlab completion fish`\ncomplete -c dvrlab -f\n";
  for (const OptionModel& o : program.options) text += line(program, o, "");
  for (const VerbModel& v : program.verbs) {
    text += "complete -c dvrlab -n __fish_use_subcommand -a " + v.name + " -d " + quoted(v.summary) + "\n";
    const std::string condition = " -n '__fish_seen_subcommand_from " + v.name + "'";
    for (const OptionModel& o : v.options) {
      if (o.argument() && completes(o) == Completes::nothing) continue;
      text += line(program, o, condition);
    }
  }
  return text;
}

}  // namespace dvrlab
