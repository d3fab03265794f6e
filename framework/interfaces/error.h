// The two ways in which dvrlab says no. Both carry one sentence: what happened, where, and the fix.
#pragma once

#include <stdexcept>
#include <string>

namespace dvrlab {

/// The input is wrong (config, file, command line). Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input is fine but this machine or this build cannot do it: no device, no library, too little memory,
/// optional data that is not there. Becomes the verdict "not supported". Exit code 3 for a single render.
class NotSupported : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dvrlab
