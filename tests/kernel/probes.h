// The probe modules that this processor can run, and the state that the cpu backend computes in.
#pragma once

#include <string>
#include <vector>

#include "tests/kernel/probe.h"

namespace dvrlab::kernel_test {

struct Isa {
  std::string name;
  const kernel_probe* probe;
};

/// Scalar first, then every instruction set of this processor. Says aloud which sets it lacks.
const std::vector<Isa>& isas();

/// Denormal numbers are kept, as on every thread of the cpu backend.
class KeepDenormals {
 public:
  KeepDenormals();
  ~KeepDenormals();
  KeepDenormals(const KeepDenormals&) = delete;
  KeepDenormals& operator=(const KeepDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace dvrlab::kernel_test
