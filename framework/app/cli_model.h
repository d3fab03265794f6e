// The command line as data: what help, completion scripts and the manual page are made from. Filled from the CLI11
// definition in command_line.cpp, so that it is written down once.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/app/verb_texts.h"

namespace dvrlab {

struct OptionModel {
  std::vector<std::string> names;  // {"-o", "--output"}; empty for an argument
  std::string value;               // "FILE", "KEY=VALUE": what follows; "" for a flag
  std::vector<std::string> choices;
  std::string description, group, default_value;
  bool required = false;
  bool repeats = false;  // may be given more than once
  bool argument() const { return names.empty(); }
};

struct VerbModel {
  std::string name, group, summary, description, json;
  std::vector<OptionModel> options;  // arguments first
  std::vector<Example> examples;
};

struct ProgramModel {
  std::string name, summary;
  std::vector<OptionModel> options;  // of every verb
  std::vector<VerbModel> verbs;
  const VerbModel* find(const std::string& verb) const;
  std::vector<std::string> verb_names() const;
  /// Without --json where the verb has none; with what it prints where it has.
  std::vector<OptionModel> general_options(const VerbModel& verb) const;
};

/// In command_line.cpp.
ProgramModel program_model();

/// "dvrlab render [OPTIONS] CONFIG".
std::string usage_line(const ProgramModel& program, const VerbModel& verb);

nlohmann::ordered_json model_json(const ProgramModel& program);

/// "dvrlab 0.1.0", the ABI of its plugins, its compiler.
std::string version_text();

}  // namespace dvrlab
