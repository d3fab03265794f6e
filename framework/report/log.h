// What people see while it runs: lines on stderr that begin with the stage's name, and a progress line on a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace dvrlab {

/// "scene: engine.nrrd ..." on stderr.
void log_line(const char* stage, const std::string& text);

/// One line at the bottom of the terminal: cases done, the one that runs, time left. Where stderr is no terminal, a
/// log line every ten seconds.
class Progress {
 public:
  explicit Progress(std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// `done` cases are through, `name` begins.
  void show(std::size_t done, const std::string& name);

 private:
  std::size_t total_;
  std::chrono::steady_clock::time_point start_, said_;
};

}  // namespace dvrlab
