/* What the probe module of precision fp64 exports: the kernel language's elementary functions over arrays. */
#ifndef DVRLAB_TESTS_KERNEL_PROBE64_H
#define DVRLAB_TESTS_KERNEL_PROBE64_H

typedef void (*probe64_map)(const double* x, double* y, long n);

typedef struct kernel_probe64 {
  probe64_map rcp, rsqrt, sqrt, exp, transmittance, phi1, sin2pi, cos2pi, floor, rabs, power20;
} kernel_probe64;

/* extern "C" const kernel_probe64* dvrlab_kernel_probe(void); */

#endif
