// Functions that use the widest instructions of the machine that the program runs on, with the same numbers on every
// one.
#pragma once

/// In front of a function: it is compiled for AVX2 as well, and the loader chooses. Clang 14 has no clones of
/// templates, other processors no AVX2: one version there.
#if defined(__x86_64__) && !defined(__clang__)
#define DVRLAB_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define DVRLAB_WIDE
#endif
