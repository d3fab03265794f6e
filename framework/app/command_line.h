// The command line: which verbs and options there are. What they do is in verb_<name>.cpp, what the help says of them
// in verb_texts.cpp.
#pragma once

namespace dvrlab {

/// Parses, runs the verb and returns its exit code; 2 for a command line that is wrong, said in one line.
int run_command_line(int argc, char** argv);

}  // namespace dvrlab
