/* The C ABI between the cpu backend and kernel modules (sampler, estimator, march, stage), one shared library per
 * instruction set, and one more in double ("fp64", one lane: docs/adr/0006). Plain C: a module neither allocates nor
 * throws, and nothing but its entry point is visible.
 *
 * The three meet in a chunk that stays in the L1 cache: the sampler fills it, the estimator integrates each
 * segment, the compositor consumes it front to back. Arrays hold DVR_CHUNK rows of `width` lanes. */
#ifndef DVRLAB_KERNEL_MODULE_H
#define DVRLAB_KERNEL_MODULE_H

#define DVR_KERNEL_ABI 7
#define DVR_CHUNK 8      /* segments per chunk */
#define DVR_MAX_WIDTH 16 /* lanes of the widest instruction set */
#define DVR_WALK_OPEN (1 << 30)

enum { DVR_F32 = 0, DVR_I32 = 1, DVR_VEC4 = 2 };
enum {
  DVR_ELEMENT_U8,
  DVR_ELEMENT_I8,
  DVR_ELEMENT_U16,
  DVR_ELEMENT_I16,
  DVR_ELEMENT_F32,
  DVR_ELEMENT_VEC4,
  DVR_ELEMENT_I32,
  DVR_ELEMENT_IVEC4
};
/* Bits that choose the compiled variant; a sampler with the last one answers `values` and nothing else. */
enum { DVR_FEATURE_RGB = 1, DVR_FEATURE_FULL = 2, DVR_FEATURE_VALUES = 4 };

typedef struct dvr_uniform {
  const char* name;
  int type;
  double f[4]; /* modules in fp32 round them */
  int i;
} dvr_uniform;

typedef struct dvr_buffer {
  const char* name;
  int element;
  const void* data;
  unsigned long long count; /* elements */
  const void* data64;       /* the same numbers in double for fp64 modules: F32 and VEC4 that are computed, not voxels
                               in their own type; 0 for none */
} dvr_buffer;

#define DVR_REAL float
#define DVR_OF(name) name
#include "framework/interfaces/kernel_calls.h"
#undef DVR_REAL
#undef DVR_OF
#define DVR_REAL double
#define DVR_OF(name) name##64
#include "framework/interfaces/kernel_calls.h"
#undef DVR_REAL
#undef DVR_OF

/* EntrySurface of kernel_unit.h: finds the faces that each ray may enter and calls rays->try_face for them. */
typedef struct dvr_entry_surface {
  const char* name;
  const void* index; /* the backend's */
  void (*find)(const void* index, dvr_entries* rays);
  void (*find64)(const void* index, dvr_entries64* rays);
} dvr_entry_surface;

/* The field that a stage asks: the sampler module's state and its function. */
typedef struct dvr_field {
  const void* frame;
  dvr_values values;
  dvr_values64 values64;
} dvr_field;

typedef struct dvr_bindings {
  const dvr_uniform* uniforms;
  int uniform_count;
  const dvr_buffer* buffers;
  int buffer_count;
  const dvr_entry_surface* surfaces;
  int surface_count;
  dvr_field field; /* stages only */
} dvr_bindings;

typedef struct dvr_kernel_module {
  int abi;          /* DVR_KERNEL_ABI */
  const char* kind; /* sampler | estimator | march | stage */
  const char* name;
  int width;                         /* lanes */
  int packet_columns;                /* pixels of a packet in x; width / columns in y */
  unsigned frame_bytes, frame_align; /* memory that init() wants, the largest of its variants */
  unsigned packet_bytes;             /* of dvr_packet::walk, 0 for none */
  /* Constructs the per-frame state in `frame` for the given DVR_* feature bits and names the functions that
   * work on it. Returns 0, or 1 and writes what the bindings lack to `missing` (128 bytes). A module in fp32 has
   * init, one in fp64 has init64; the other is 0. */
  int (*init)(void* frame, const dvr_bindings* bindings, int features, dvr_calls* calls, char* missing);
  int (*init64)(void* frame, const dvr_bindings* bindings, int features, dvr_calls64* calls, char* missing);
} dvr_kernel_module;

/* extern "C" const dvr_kernel_module* dvrlab_kernel_module(void); */

#endif
