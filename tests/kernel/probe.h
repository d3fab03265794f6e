/* What a probe module exports: the kernel language's own functions over arrays, one module per instruction set.
 * Every count is a multiple of 16. Plain C, like the interface of real kernel modules. */
#ifndef DVRLAB_TESTS_KERNEL_PROBE_H
#define DVRLAB_TESTS_KERNEL_PROBE_H

#include "framework/interfaces/kernel_module.h"

typedef void (*probe_map)(const float* x, float* y, long n);

typedef struct kernel_probe {
  int width;
  probe_map rcp, rsqrt, sqrt, exp, transmittance, phi1, sin2pi, cos2pi, floor;
  void (*power)(const float* x, int n_power, float* y, long n);
  void (*pcg)(const int* x, int* y, long n);
  void (*jitter)(const int* x, const int* y, float* offset, long n); /* step 1, jitter 1, seed 7 */

  /* `element` is one of DVR_ELEMENT_U8 .. DVR_ELEMENT_F32; results are structures of arrays of n. */
  void (*fetch1)(int element, const void* data, const int* i, float* out, long n);
  void (*fetch2)(int element, const void* data, const int* i, float* out, long n);                        /* 2 n */
  void (*fetch_cell)(int element, const void* data, const int* base, int dy, int dz, float* out, long n); /* 8 n */
  /* 16 n: the values of the corners, then the levels beside them. Not in the scalar module. */
  void (*fetch_beside)(int element, const void* data, const int* base, int dy, int dz, float* out, long n);
  void (*fetch4)(const float* table, const int* i, float* out, long n);                        /* 4 n */
  void (*fetch4u)(const float* table, int i, float* out, long n);                              /* 4 n */
  void (*fetch4_affine)(const float* table, const int* i, const float* w, float* out, long n); /* 4 n */
  void (*fetchi)(const int* table, const int* i, int* out, long n);
  void (*fetchi8)(const unsigned char* table, const int* i, int* out, long n);
} kernel_probe;

/* extern "C" const kernel_probe* dvrlab_kernel_probe(void); */

#endif
