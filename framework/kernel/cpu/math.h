// The mathematics of the kernel language: the text of every backend, or in precision fp64 libm's accuracy (not guarded:
// included into every variant).
// clang-format off
#ifdef DVR_ISA_fp64
#include "framework/kernel/cpu/math_fp64.h"
#else
#include "framework/kernel/math.kernel"
#endif
#include "framework/kernel/algebra.kernel"
// clang-format on
