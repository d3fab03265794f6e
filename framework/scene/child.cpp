#include "framework/scene/child.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <new>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

// What a child says beside its result.
struct Report {
  enum class Outcome { unfinished, done, input_error, not_supported } outcome;
  char file[4096];
  char message[8192];
};

Report* report_of_child = nullptr;  // set in children only

void keep(char* place, std::size_t size, const std::string& text) { std::snprintf(place, size, "%s", text.c_str()); }

void write_all(int pipe, const Bytes& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::write(pipe, bytes.data() + at, bytes.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;  // the parent is gone
    at += static_cast<std::size_t>(n);
  }
}

Bytes read_all(int pipe) {
  Bytes all;
  std::array<std::uint8_t, 65536> part;
  for (;;) {
    const ssize_t n = ::read(pipe, part.data(), part.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return all;
    all.insert(all.end(), part.begin(), part.begin() + n);
  }
}

// The address space that this process has now, and `more`.
void limit_memory(std::uint64_t more) {
  std::ifstream in("/proc/self/statm");
  std::uint64_t pages = 0;
  if (!(in >> pages)) return;
  const rlim_t most = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + more;
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_AS, &limit);
}

void run(const std::function<Bytes()>& work, int pipe, Report& report) {
  using enum Report::Outcome;
  const auto fail = [&](Report::Outcome how, const std::exception& e) {
    keep(report.message, sizeof report.message, e.what());
    report.outcome = how;
  };
  try {
    write_all(pipe, work());
    report.outcome = done;
  } catch (const InputError& e) {
    fail(input_error, e);
  } catch (const NotSupported& e) {
    fail(not_supported, e);
  } catch (...) {  // of the library: unfinished
  }
}

[[noreturn]] void be_child(const std::function<Bytes()>& work, std::uint64_t memory, int pipe, Report& report) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const int noise : {STDOUT_FILENO, STDERR_FILENO})
    if (nowhere >= 0) ::dup2(nowhere, noise);
  report_of_child = &report;
  limit_memory(memory);
  run(work, pipe, report);
  ::_exit(0);  // nothing of the parent's is flushed or destroyed here
}

}  // namespace

std::shared_ptr<void> shared_memory(std::uint64_t bytes, const std::string& where) {
  void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw NotSupported(where + ": no memory for " + std::to_string(bytes) + " bytes");
  return {memory, [bytes](void* m) { ::munmap(m, bytes); }};
}

void reading(const std::string& file) {
  if (report_of_child) keep(report_of_child->file, sizeof report_of_child->file, file);
}

Bytes in_child(const std::string& library, std::uint64_t memory, const std::function<Bytes()>& work) {
  const auto shared = shared_memory(sizeof(Report), library);
  Report& report = *new (shared.get()) Report{};
  int ends[2] = {-1, -1};
  const pid_t child = ::pipe2(ends, O_CLOEXEC) == 0 ? ::fork() : -1;
  if (child == 0) be_child(work, memory, ends[1], report);
  if (ends[1] >= 0) ::close(ends[1]);
  Bytes result = child > 0 ? read_all(ends[0]) : Bytes{};
  if (ends[0] >= 0) ::close(ends[0]);
  if (child < 0) throw NotSupported("a child process for " + library + " cannot be started");
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (report.outcome == Report::Outcome::done) return result;
  if (report.outcome == Report::Outcome::input_error) throw InputError(report.message);
  if (report.outcome == Report::Outcome::not_supported) throw NotSupported(report.message);
  throw InputError(std::string(report.file) + ": " + library + " gives up on it" +
                   (WIFSIGNALED(status) ? " (signal " + std::to_string(WTERMSIG(status)) + ")" : "") +
                   "; the file is damaged");
}

}  // namespace dvrlab
