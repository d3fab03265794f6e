#include "framework/report/log.h"

#include <unistd.h>

#include <cstdio>

namespace dvrlab {
namespace {

constexpr const char* clear_line = "\r\033[K";
bool progress_shown = false;

bool terminal() {
  static const bool is = isatty(STDERR_FILENO) == 1;
  return is;
}

void clear_progress() {
  if (progress_shown) std::fputs(clear_line, stderr);
  progress_shown = false;
}

}  // namespace

void log_line(const char* stage, const std::string& text) {
  clear_progress();
  std::fprintf(stderr, "%s: %s\n", stage, text.c_str());
}

Progress::Progress(std::size_t total) : total_(total), start_(std::chrono::steady_clock::now()), said_(start_) {}

Progress::~Progress() { clear_progress(); }

void Progress::show(std::size_t done, const std::string& name) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal() && now - said_ < std::chrono::seconds(10)) return;
  said_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  char left[48] = "";
  if (done > 0) {
    const long seconds =
        static_cast<long>(elapsed / static_cast<double>(done) * static_cast<double>(total_ - done) + 0.5);
    std::snprintf(left, sizeof left, ", %ld:%02ld left", seconds / 60, seconds % 60);
  }
  if (!terminal())
    return log_line("report", std::to_string(done) + " of " + std::to_string(total_) + " cases done" + left);
  std::fprintf(stderr, "%s[%zu/%zu%s] %.60s", clear_line, done, total_, left, name.c_str());
  std::fflush(stderr);
  progress_shown = true;
}

}  // namespace dvrlab
