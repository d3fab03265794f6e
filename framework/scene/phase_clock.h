// Wall and CPU time of a phase.
#pragma once

#include <sys/resource.h>

#include <chrono>

namespace dvrlab {

/// Seconds since construction.
class PhaseClock {
 public:
  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  /// User and system time of all threads of the process: what a software GPU really costs.
  double cpu() const { return process_seconds() - cpu_start_; }

 private:
  static double process_seconds() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  }
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double cpu_start_ = process_seconds();
};

}  // namespace dvrlab
