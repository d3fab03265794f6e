#include "framework/app/usage_error.h"

#include <algorithm>
#include <cctype>

#include "framework/config/words.h"
#include "framework/plugin/registry.h"

namespace dvrlab {
namespace {

bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && std::isdigit(static_cast<unsigned char>(word[1])) == 0 && word[1] != '.';
}

/// The option that `word` names: "--set", "--set=x", "-o", "-oimage.png".
const OptionModel* named(const std::vector<OptionModel>& options, const std::string& word) {
  for (const OptionModel& o : options) {
    for (const std::string& name : o.names) {
      const bool is_short = name.size() == 2;
      if (is_short ? word.compare(0, 2, name) == 0 : word.substr(0, word.find('=')) == name) return &o;
    }
  }
  return nullptr;
}

std::vector<std::string> all_names(const std::vector<OptionModel>& options) {
  std::vector<std::string> names;
  for (const OptionModel& o : options) names.insert(names.end(), o.names.begin(), o.names.end());
  return names;
}

/// CLI11's sentences end without what to do; some have several lines.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

std::string usage_error(const ProgramModel& program, const std::vector<std::string>& arguments,
                        const std::string& reason) {
  std::vector<OptionModel> options = program.options;
  const VerbModel* verb = nullptr;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word == "--") break;
    if (is_option(word)) {
      const OptionModel* known = named(options, word);
      if (known == nullptr) {
        const std::string where = program.name + (verb != nullptr ? " " + verb->name : "");
        const std::string written = word.substr(0, word.find('='));
        return where + ": unknown option '" + written + "'" + did_you_mean(written, all_names(options)) +
               "; options: " + join_words(all_names(options)) + " (see " + where + " --help)";
      }
      if (!known->value.empty() && word.find('=') == std::string::npos && word.size() > 1) {
        const bool value_follows = word.compare(0, 2, "--") == 0 || word.size() == 2;
        if (value_follows) ++i;
      }
    } else if (verb == nullptr) {
      verb = program.find(word);
      if (verb == nullptr)
        return "unknown verb '" + word + "'" + did_you_mean(word, program.verb_names()) +
               "; verbs: " + join_words(program.verb_names()) + " (see dvrlab --help)";
      options.insert(options.end(), verb->options.begin(), verb->options.end());
    }
  }
  if (verb == nullptr) return "a verb is missing; verbs: " + join_words(program.verb_names()) + " (see dvrlab --help)";
  return program.name + " " + verb->name + ": " + one_line(reason) + "; usage: " + usage_line(program, *verb) +
         " (see dvrlab help " + verb->name + ")";
}

}  // namespace dvrlab
