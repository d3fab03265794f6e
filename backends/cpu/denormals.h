// How every thread of the cpu backend treats denormal numbers.
#pragma once

#include <xmmintrin.h>

namespace dvrlab::cpu {

/// Denormal numbers are kept (neither FTZ nor DAZ), whatever the caller had: that is what lavapipe and llvmpipe do in
/// compute shaders, and what the Vulkan backend asks real GPUs for.
class KeepDenormals {
 public:
  KeepDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ & ~0x8040u); }
  ~KeepDenormals() { _mm_setcsr(saved_); }
  KeepDenormals(const KeepDenormals&) = delete;
  KeepDenormals& operator=(const KeepDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace dvrlab::cpu
