/* The C ABI between the cpu backend and kernel modules (sampler, estimator, march, stage), one shared library per
 * instruction set. Plain C: a module neither allocates nor throws, and nothing but its entry point is visible.
 *
 * The three meet in a chunk that stays in the L1 cache: the sampler fills it, the estimator integrates each
 * segment, the compositor consumes it front to back. Arrays hold DVR_CHUNK rows of `width` lanes. */
#ifndef DVRLAB_KERNEL_MODULE_H
#define DVRLAB_KERNEL_MODULE_H

#define DVR_KERNEL_ABI 2
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
  DVR_ELEMENT_I32
};
enum { DVR_FEATURE_RGB = 1, DVR_FEATURE_FULL = 2 }; /* bits that choose the compiled variant */

typedef struct dvr_uniform {
  const char* name;
  int type;
  float f[4];
  int i;
} dvr_uniform;

typedef struct dvr_buffer {
  const char* name;
  int element;
  const void* data;
  unsigned long long count; /* elements */
} dvr_buffer;

typedef struct dvr_bindings {
  const dvr_uniform* uniforms;
  int uniform_count;
  const dvr_buffer* buffers;
  int buffer_count;
} dvr_bindings;

/* A packet of rays, structure of arrays. Positions are origin + s * direction, s = arc length in world units
 * from the entry point of the ray. */
typedef struct dvr_packet {
  alignas(64) float grid_o[3][DVR_MAX_WIDTH]; /* sampler coordinates of the entry point */
  float grid_d[3][DVR_MAX_WIDTH];             /* sampler coordinates per world length */
  float world_o[3][DVR_MAX_WIDTH];            /* world coordinates relative to the box centre */
  float world_d[3][DVR_MAX_WIDTH];            /* unit length */
  int x[DVR_MAX_WIDTH], y[DVR_MAX_WIDTH];     /* pixel */
  float length[DVR_MAX_WIDTH];                /* L: entry to exit */
  float offset[DVR_MAX_WIDTH];                /* jitter: (1 - xi) * step, 0 without */
  int n[DVR_MAX_WIDTH];                       /* number of segments (a walking sampler: DVR_WALK_OPEN until it is
                                                 known); set to i when the ray has ended early */
  int i[DVR_MAX_WIDTH];                       /* next segment */
  int skipped[DVR_MAX_WIDTH];                 /* segments that were skipped as empty */
  int carried;                                /* 1: the last chunk's final rows serve the next (sampler's own) */
  void* walk;                                 /* packet_bytes of the sampler's own, 64-byte aligned */
  float color[3][DVR_MAX_WIDTH];              /* accumulated radiance */
  float trans[3][DVR_MAX_WIDTH];              /* accumulated transmittance */
  int samples[DVR_MAX_WIDTH];                 /* segments that were composited */
  int terminated[DVR_MAX_WIDTH];              /* 1: ended by early termination */
} dvr_packet;

/* Row r of s and v: `centre`: sample of segment i+r-1 (row 0 is the one before); `ends`: front end of segment
 * i+r. Two rows more than segments, so both v_prev/v/v_next and v0/v1 are rows k, k+1, k+2. A walking
 * sampler has no neighbours for `centre`: only the middle one of the three rows is filled. */
typedef struct dvr_chunk {
  alignas(64) float s[(DVR_CHUNK + 2) * DVR_MAX_WIDTH];
  float v[(DVR_CHUNK + 2) * DVR_MAX_WIDTH];
  float g[3][(DVR_CHUNK + 2) * DVR_MAX_WIDTH]; /* world gradient of v, where it was needed */
  float len[DVR_CHUNK * DVR_MAX_WIDTH];        /* true length; 0: no segment (masked) */
  float c[3][DVR_CHUNK * DVR_MAX_WIDTH];       /* radiance of the segment */
  float t[3][DVR_CHUNK * DVR_MAX_WIDTH];       /* transmittance; grey: the first only */
  int n;                                       /* rows in use */
} dvr_chunk;

typedef struct dvr_sampler_calls {
  void (*start)(const void* frame, dvr_packet* packet);
  /* Fills the next chunk; returns its number of segments, 0 when every lane is through. */
  int (*fill)(const void* frame, dvr_packet* packet, dvr_chunk* chunk);
} dvr_sampler_calls;

typedef struct dvr_estimator_calls {
  void (*integrate)(const void* frame, const dvr_packet* packet, dvr_chunk* chunk);
} dvr_estimator_calls;

typedef struct dvr_march_calls {
  void (*begin)(const void* frame, int x, int y, dvr_packet* packet);
  void (*composite)(const void* frame, dvr_packet* packet, const dvr_chunk* chunk);
  /* radiance rgb incl. background, transmittance rgb, per lane */
  void (*finish)(const void* frame, dvr_packet* packet);
} dvr_march_calls;

typedef struct dvr_stage_calls {
  /* Voxels (x0 .. x1-1, y, z) of the output volume, in order. */
  void (*fill_row)(const void* frame, int x0, int x1, int y, int z, float* out);
} dvr_stage_calls;

typedef union dvr_calls {
  dvr_sampler_calls sampler;
  dvr_estimator_calls estimator;
  dvr_march_calls march;
  dvr_stage_calls stage;
} dvr_calls;

typedef struct dvr_kernel_module {
  int abi;          /* DVR_KERNEL_ABI */
  const char* kind; /* sampler | estimator | march | stage */
  const char* name;
  int width;                         /* lanes */
  int packet_columns;                /* pixels of a packet in x; width / columns in y */
  unsigned frame_bytes, frame_align; /* memory that init() wants, the largest of its variants */
  unsigned packet_bytes;             /* of dvr_packet::walk, 0 for none */
  /* Constructs the per-frame state in `frame` for the given DVR_* feature bits and names the functions that
   * work on it. Returns 0, or 1 and writes what the bindings lack to `missing` (128 bytes). */
  int (*init)(void* frame, const dvr_bindings* bindings, int features, dvr_calls* calls, char* missing);
} dvr_kernel_module;

/* extern "C" const dvr_kernel_module* dvrlab_kernel_module(void); */

#endif
