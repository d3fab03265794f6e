#include "framework/app/man_page.h"

#include "framework/app/help_text.h"

namespace dvrlab {
namespace {

/// Text as roff: a minus that can be copied, no escapes, no line that looks like a request.
std::string roff(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if (c == '\'') {
      result += "\\(aq";
    } else {
      result += c;
    }
  }
  return result.starts_with('.') ? "\\&" + result : result;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (char c : roff(text)) result += c == '"' ? "\\(dq" : std::string(1, c);
  return result + "\"";
}

std::string paragraph(const std::string& text) { return ".PP\n" + roff(text) + "\n"; }

std::string tagged(const std::string& tag, const std::string& text) {
  return ".TP\n\\fB" + roff(tag) + "\\fR\n" + roff(text) + "\n";
}

std::string options_text(const std::vector<OptionModel>& options) {
  std::string text;
  for (const OptionModel& o : options) text += tagged(option_heading(o), option_words(o));
  return text;
}

std::string verb_text(const ProgramModel& program, const VerbModel& v) {
  std::string text = ".SS " + quoted(usage_line(program, v)) + "\n" + roff(v.description) + "\n";
  text += options_text(v.options);
  if (!v.json.empty()) text += tagged("--json", "Prints on stdout: " + v.json + ".");
  for (const Example& e : v.examples)
    text += paragraph(std::string(e.what) + ":") + ".RS 4\n.nf\n" + roff(e.command) + "\n.fi\n.RE\n";
  return text;
}

}  // namespace

std::string man_page(const ProgramModel& program) {
  std::string text = ".TH DVRLAB 1 \"\" " + quoted(std::string("dvrlab ") + DVRLAB_VERSION) + " \"User Commands\"\n";
  text += ".SH NAME\n" + program.name + " \\- " + roff(program.summary) + "\n";
  text += ".SH SYNOPSIS\n.B " + program.name + "\n.I VERB\n[\\fIOPTIONS\\fR] ...\n";
  text += ".SH DESCRIPTION\n" +
          roff(
              "Optical models, estimators, samplers, illumination, file readers, metrics and backends are plugins; an "
              "experiment is one JSON file. Answers go to stdout, with --json for programs; the log and errors go to "
              "stderr. The examples start "
              "from the root of the sources.") +
          "\n.SH OPTIONS\n" + options_text(program.options) + ".SH VERBS\n";
  for (const VerbModel& v : program.verbs) text += verb_text(program, v);
  text += ".SH EXIT STATUS\n";
  for (const ExitCode& c : exit_codes()) text += tagged(std::to_string(c.code), std::string(c.meaning) + ".");
  text += ".SH ENVIRONMENT\n";
  for (const EnvironmentVariable& e : environment_variables()) text += tagged(e.name, e.meaning);
  return text;
}

}  // namespace dvrlab
