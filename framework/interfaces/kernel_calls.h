/* What kernel modules share while they march, for one type of number: included by kernel_module.h with DVR_REAL and
 * DVR_OF(name) set, once for float (dvr_packet, ...) and once for double (dvr_packet64, ...). Not guarded. */

/* A packet of rays, structure of arrays. Positions are origin + s * direction, s = arc length in world units
 * from the entry point of the ray. */
typedef struct DVR_OF(dvr_packet) {
  alignas(64) DVR_REAL grid_o[3][DVR_MAX_WIDTH]; /* sampler coordinates of the entry point */
  DVR_REAL grid_d[3][DVR_MAX_WIDTH];             /* sampler coordinates per world length */
  DVR_REAL world_o[3][DVR_MAX_WIDTH];            /* world coordinates relative to the box centre */
  DVR_REAL world_d[3][DVR_MAX_WIDTH];            /* unit length */
  int x[DVR_MAX_WIDTH], y[DVR_MAX_WIDTH];        /* pixel */
  DVR_REAL length[DVR_MAX_WIDTH];                /* L: entry to exit */
  DVR_REAL offset[DVR_MAX_WIDTH];                /* jitter: (1 - xi) * step, 0 without */
  int n[DVR_MAX_WIDTH];                          /* number of segments (a walking sampler: DVR_WALK_OPEN until it is
                                                    known); set to i when the ray has ended early */
  int i[DVR_MAX_WIDTH];                          /* next segment */
  int skipped[DVR_MAX_WIDTH];                    /* segments that were skipped as empty */
  int carried;                                   /* 1: the last chunk's final rows serve the next (sampler's own) */
  void* walk;                                    /* packet_bytes of the sampler's own, 64-byte aligned */
  DVR_REAL color[3][DVR_MAX_WIDTH];              /* accumulated radiance */
  DVR_REAL trans[3][DVR_MAX_WIDTH];              /* accumulated transmittance */
  int samples[DVR_MAX_WIDTH];                    /* segments that were composited */
  int terminated[DVR_MAX_WIDTH];                 /* 1: ended by early termination */
} DVR_OF(dvr_packet);

/* Row r of s and v: `centre`: sample of segment i+r-1 (row 0 is the one before); `ends`: front end of segment
 * i+r. Two rows more than segments, so both v_prev/v/v_next and v0/v1 are rows k, k+1, k+2. A walking
 * sampler has no neighbours for `centre`: only the middle one of the three rows is filled. */
typedef struct DVR_OF(dvr_chunk) {
  alignas(64) DVR_REAL s[(DVR_CHUNK + 2) * DVR_MAX_WIDTH];
  DVR_REAL v[(DVR_CHUNK + 2) * DVR_MAX_WIDTH];
  DVR_REAL g[3][(DVR_CHUNK + 2) * DVR_MAX_WIDTH]; /* world gradient of v, where it was needed */
  DVR_REAL h[3][DVR_CHUNK * DVR_MAX_WIDTH];       /* a walking sampler: at the front end of each segment, where the
                                                    gradient may jump; g is at the back end then */
  DVR_REAL m[3][(DVR_CHUNK + 2) * DVR_MAX_WIDTH]; /* light volumes' value, where something may be lit */
  DVR_REAL len[DVR_CHUNK * DVR_MAX_WIDTH];        /* true length; 0: no segment (masked) */
  DVR_REAL c[3][DVR_CHUNK * DVR_MAX_WIDTH];       /* radiance of the segment */
  DVR_REAL t[3][DVR_CHUNK * DVR_MAX_WIDTH];       /* transmittance; grey: the first only */
  int n;                                          /* rows in use */
} DVR_OF(dvr_chunk);

/* Rays that look for the next face of a surface (framework/kernel/entry.kernel). try_face judges one face for every
 * lane with `on`, and keeps it in s and face where it is the next one so far. */
typedef struct DVR_OF(dvr_entries) {
  alignas(64) DVR_REAL o[3][DVR_MAX_WIDTH]; /* sampler coordinates of the entry point */
  DVR_REAL d[3][DVR_MAX_WIDTH];             /* sampler coordinates per arc length */
  DVR_REAL axes[9][DVR_MAX_WIDTH];          /* the frame: across, up, along */
  DVR_REAL from[DVR_MAX_WIDTH];             /* bounds of the search */
  DVR_REAL after[DVR_MAX_WIDTH];
  int after_face[DVR_MAX_WIDTH];
  DVR_REAL s[DVR_MAX_WIDTH]; /* the next face: arc position and index, 3e38 and -1 for none */
  int face[DVR_MAX_WIDTH];
  int on[DVR_MAX_WIDTH]; /* lanes that take part: in find() all that search, in try_face() those that may enter the face
                          */
  int width;
  void* kernel; /* the module's own */
  void (*try_face)(void* kernel, struct DVR_OF(dvr_entries) * rays, int face);
} DVR_OF(dvr_entries);

/* v[l] = the stored value at sampler coordinates (p[0][l], p[1][l], p[2][l]), for one packet's lanes. */
typedef void (*DVR_OF(dvr_values))(const void* frame, const DVR_REAL (*p)[DVR_MAX_WIDTH], DVR_REAL* v);

typedef struct DVR_OF(dvr_sampler_calls) {
  void (*start)(const void* frame, DVR_OF(dvr_packet) * packet);
  /* Fills the next chunk; returns its number of segments, 0 when every lane is through. */
  int (*fill)(const void* frame, DVR_OF(dvr_packet) * packet, DVR_OF(dvr_chunk) * chunk);
  DVR_OF(dvr_values) values; /* 0: the sampler cannot be asked at positions */
} DVR_OF(dvr_sampler_calls);

typedef struct DVR_OF(dvr_estimator_calls) {
  void (*integrate)(const void* frame, const DVR_OF(dvr_packet) * packet, DVR_OF(dvr_chunk) * chunk);
} DVR_OF(dvr_estimator_calls);

typedef struct DVR_OF(dvr_march_calls) {
  void (*begin)(const void* frame, int x, int y, DVR_OF(dvr_packet) * packet);
  void (*composite)(const void* frame, DVR_OF(dvr_packet) * packet, const DVR_OF(dvr_chunk) * chunk);
  /* radiance rgb incl. background, transmittance rgb, per lane */
  void (*finish)(const void* frame, DVR_OF(dvr_packet) * packet);
} DVR_OF(dvr_march_calls);

typedef struct DVR_OF(dvr_stage_calls) {
  /* Voxels (x0 .. x1-1, y, z) of the output volume, in order: channel c at out + c * plane. */
  void (*fill_row)(const void* frame, int x0, int x1, int y, int z, DVR_REAL* out, unsigned long long plane);
} DVR_OF(dvr_stage_calls);

typedef union DVR_OF(dvr_calls) {
  DVR_OF(dvr_sampler_calls) sampler;
  DVR_OF(dvr_estimator_calls) estimator;
  DVR_OF(dvr_march_calls) march;
  DVR_OF(dvr_stage_calls) stage;
} DVR_OF(dvr_calls);
