#include <algorithm>
#include <cstdio>

#include "framework/app/completion.h"
#include "framework/app/verbs.h"
#include "framework/config/sections.h"
#include "framework/interfaces/error.h"
#include "framework/plugin/registry.h"

namespace dvrlab {
namespace {

/// What `list KIND` takes: kinds of plugins, and sections with types of the framework's own.
std::vector<std::string> kinds(const Registry& registry) {
  std::vector<std::string> words;
  for (const PluginEntryInfo& e : registry.entries()) words.push_back(e.kind);
  for (const SectionType& s : section_types())
    if (*s.type != '\0') words.emplace_back(s.section);
  return words;
}

/// What `describe TYPE` takes.
std::vector<std::string> types(const Registry& registry) {
  std::vector<std::string> words;
  for (const PluginEntryInfo& e : registry.entries()) {
    if (e.descriptor == nullptr) continue;
    words.push_back(e.name);
    words.push_back(e.kind + "." + e.name);
  }
  for (const SectionType& s : section_types())
    words.push_back(*s.type == '\0' ? s.section : std::string(s.section) + "." + s.type);
  words.insert(words.end(), top_sections().begin(), top_sections().end());
  return words;
}

void print_words(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  for (const std::string& word : words) std::printf("%s\n", word.c_str());
}

}  // namespace

int completion_verb(const Options& o) {
  if (o.json) throw InputError("completion: has no --json; it prints a script");
  if (o.name == "kinds" || o.name == "types") {
    const Registry registry(o.plugin_path);
    print_words(o.name == "kinds" ? kinds(registry) : types(registry));
    return 0;
  }
  const ProgramModel program = program_model();
  const std::string script = o.name == "bash"  ? bash_completion(program)
                             : o.name == "zsh" ? zsh_completion(program)
                                               : fish_completion(program);
  std::fputs(script.c_str(), stdout);
  return 0;
}

}  // namespace dvrlab
