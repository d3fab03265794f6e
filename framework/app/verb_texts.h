// What the help says of each verb beside its options. A new verb needs an entry here and one in command_line.cpp.
#pragma once

#include <vector>

namespace dvrlab {

/// A command line that works from the root of the sources, in the order of the table: tests run them all.
struct Example {
  const char* command;
  const char* what;
};

struct VerbText {
  const char* name;
  const char* group;
  const char* summary;      // one line
  const char* description;  // a paragraph
  const char* json;         // what --json prints; nullptr: the verb has no --json
  std::vector<Example> examples;
};

/// In the order of the help.
const std::vector<VerbText>& verb_texts();

/// Exit codes and what they mean.
struct ExitCode {
  int code;
  const char* meaning;
};
const std::vector<ExitCode>& exit_codes();

struct EnvironmentVariable {
  const char* name;
  const char* meaning;
};
const std::vector<EnvironmentVariable>& environment_variables();

}  // namespace dvrlab
