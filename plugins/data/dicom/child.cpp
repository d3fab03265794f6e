#include "plugins/data/dicom/child.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>

#include "framework/interfaces/error.h"

namespace dvrlab::dicom {
namespace {

enum Outcome { done = 0, input_error = 1, not_supported = 2, other_error = 3 };

// What a child leaves behind.
struct Report {
  char file[4096];
  char message[8192];
};

Report* report_of_child = nullptr;  // set in children only

void keep(char* place, std::size_t size, const std::string& text) { std::snprintf(place, size, "%s", text.c_str()); }

Outcome run(const std::function<void()>& work, Report& report) {
  try {
    work();
    return done;
  } catch (const InputError& e) {
    keep(report.message, sizeof report.message, e.what());
    return input_error;
  } catch (const NotSupported& e) {
    keep(report.message, sizeof report.message, e.what());
    return not_supported;
  } catch (...) {
    return other_error;
  }
}

[[noreturn]] void be_child(const std::function<void()>& work, Report& report) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  report_of_child = &report;
  ::_exit(run(work, report));  // nothing of the parent's is flushed or destroyed here
}

}  // namespace

std::shared_ptr<void> shared_memory(std::uint64_t bytes, const std::string& where) {
  void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw NotSupported(where + ": no memory for " + std::to_string(bytes) + " bytes of voxels");
  return {memory, [bytes](void* m) { ::munmap(m, bytes); }};
}

void reading(const std::string& file) {
  if (report_of_child) keep(report_of_child->file, sizeof report_of_child->file, file);
}

void in_child(const std::function<void()>& work) {
  const auto memory = shared_memory(sizeof(Report), "DICOM reader");
  Report& report = *new (memory.get()) Report{};
  const pid_t child = ::fork();
  if (child < 0) throw NotSupported("the DICOM reader cannot start a child process for GDCM");
  if (child == 0) be_child(work, report);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : other_error;
  if (code == done) return;
  if (code == input_error) throw InputError(report.message);
  if (code == not_supported) throw NotSupported(report.message);
  throw InputError(std::string(report.file) + ": GDCM gives up on it" +
                   (WIFSIGNALED(status) ? " (signal " + std::to_string(WTERMSIG(status)) + ")" : "") +
                   "; the file is damaged");
}

}  // namespace dvrlab::dicom
