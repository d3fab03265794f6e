// The probe modules that this processor can run.
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

}  // namespace dvrlab::kernel_test
