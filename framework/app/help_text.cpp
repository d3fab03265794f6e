#include "framework/app/help_text.h"

#include <algorithm>
#include <sstream>

#include "framework/config/words.h"

namespace dvrlab {
namespace {

constexpr std::size_t width = 100, column = 26;

/// Words in lines of at most `width` characters; lines after the first begin with `indent` blanks. `used`: characters
/// that the first line has already.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t used) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t at = used;
  bool first = true;
  while (words >> word) {
    if (!first && at + 1 + word.size() > width) {
      result += "\n" + std::string(indent, ' ');
      at = indent;
    } else if (!first) {
      result += " ";
      ++at;
    }
    result += word;
    at += word.size();
    first = false;
  }
  return result + "\n";
}

/// A name, and what it is in a second column.
std::string row(const std::string& name, const std::string& text) {
  std::string line = "  " + name;
  if (line.size() + 2 > column) {
    line += "\n" + std::string(column, ' ');
  } else {
    line.append(column - line.size(), ' ');
  }
  return line + wrapped(text, column, column);
}

std::string section(const std::string& title, const std::vector<OptionModel>& options, bool arguments) {
  std::string rows;
  for (const OptionModel& o : options) {
    if (o.argument() == arguments) rows += row(option_heading(o), option_words(o));
  }
  return rows.empty() ? "" : "\n" + title + ":\n" + rows;
}

std::string exit_code_rows() {
  std::string rows = "\nExit codes:\n";
  for (const ExitCode& c : exit_codes()) rows += row(std::to_string(c.code), c.meaning);
  return rows;
}

}  // namespace

std::string option_heading(const OptionModel& o) {
  return join_words(o.names) + (o.names.empty() || o.value.empty() ? "" : " ") + o.value;
}

std::string option_words(const OptionModel& o) {
  std::string text = o.description;
  if (!o.choices.empty()) text += " (" + join_words(o.choices, " | ") + ")";
  if (o.required && !o.argument()) text += " (required)";
  if (!o.default_value.empty()) text += " (default: " + o.default_value + ")";
  return text;
}

std::string overview(const ProgramModel& program) {
  std::string text = program.name + ": " + program.summary + "\n\nusage: " + program.name + " VERB [OPTIONS] ...\n";
  std::string group;
  for (const VerbModel& v : program.verbs) {
    if (v.group != group) text += "\n" + v.group + ":\n";
    group = v.group;
    text += row(v.name, v.summary);
  }
  text += section("General options", program.options, false);
  return text + exit_code_rows() +
         "\n`dvrlab help VERB` has examples. Answers go to stdout, with --json for programs; "
         "the log and errors go to stderr.\n";
}

std::string verb_help(const ProgramModel& program, const std::string& verb) {
  const VerbModel& v = *program.find(verb);
  std::string text = "dvrlab " + v.name + ": " + v.summary + "\n\nusage: " + usage_line(program, v) + "\n\n" +
                     wrapped(v.description, 0, 0);
  text += section("Arguments", v.options, true) + section("Options", v.options, false) +
          section("General options", program.general_options(v), false);
  text += "\nExamples:\n";
  for (const Example& e : v.examples) text += "  " + std::string(e.command) + "\n      " + wrapped(e.what, 6, 6);
  return text + exit_code_rows();
}

}  // namespace dvrlab
