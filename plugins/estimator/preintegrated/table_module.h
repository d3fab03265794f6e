/* The C contract between the host side of the table builder and its modules, one per instruction set. A module
 * neither allocates nor throws; every array is the caller's. Symbols as in docs/math, section B.5. */
#ifndef DVRLAB_TABLE_MODULE_H
#define DVRLAB_TABLE_MODULE_H

#include <stddef.h> /* NOLINT: a C header */
#include <stdint.h> /* NOLINT: a C header */

#ifdef __cplusplus
extern "C" {
#endif

#define DVR_TABLE_ABI 3
#define DVR_TABLE_ENTRY "dvrlab_table_module"
/* Cell arrays may be read this many elements before their first and behind their last element: zeros there, prefix
 * sums go on with their last value. */
#define DVR_TABLE_PAD 8
#define DVR_TABLE_MOST_COLUMNS 16
#define DVR_TABLE_MOST_CHANNELS 48

/* A sum that is not rounded to 53 bits: hi + lo. Differences of prefix sums next to an opaque cell need it. Null: all
 * cells are 0. */
typedef struct dvr_table_prefix {
  const double *hi, *lo; /* n entries: entry k is the sum over the cells 0 .. k-1 */
} dvr_table_prefix;

/* One direction: its cells in the order of increasing row (table_layout.h), so a descending side is mirrored. */
typedef struct dvr_table_side {
  const double* length_source[DVR_TABLE_MOST_COLUMNS];  /* cell means of the column's length terms, 1/length */
  const double* surface_source[DVR_TABLE_MOST_COLUMNS]; /* cell integrals of its surface terms */
  dvr_table_prefix length_depth[3], surface_depth[3];   /* of tau_l and of tau_s with the Diracs, per extinction */
  dvr_table_prefix length_sum[DVR_TABLE_MOST_COLUMNS];  /* of length_source: ratio tables only */
  dvr_table_prefix
      surface_sum[DVR_TABLE_MOST_COLUMNS]; /* of surface_source with the Diracs' mu_i c_i: ratio tables only */
  const double* active;                    /* n entries: how many of the cells 0 .. k-1 send light in any column */
  const int32_t* dirac_cell;               /* per cell: its index in `dirac_first`, -1 without a Dirac */
  const uint8_t* dirac_near;               /* per cell k: a Dirac in the cells k .. k + DVR_TABLE_PAD - 1 */
  const double* at_extinction[3];          /* tau_l at the n grid values */
  const double* at_source[DVR_TABLE_MOST_COLUMNS]; /* the column's length terms at the n grid values */
  float* out[DVR_TABLE_MOST_CHANNELS / 4];         /* per group of 4 channels, 64-byte aligned */
} dvr_table_side;

enum { DVR_TABLE_ZERO, DVR_TABLE_TOTAL, DVR_TABLE_BACK, DVR_TABLE_SECOND, DVR_TABLE_THIRD, DVR_TABLE_TRANSMITTANCE };

typedef struct dvr_table_job {
  int32_t n, extinctions, columns, groups;
  double h;                                      /* nominal length of a segment, > 0 */
  int32_t extinction_of[DVR_TABLE_MOST_COLUMNS]; /* the extinction channel that a column is seen through */
  int32_t moments[DVR_TABLE_MOST_COLUMNS];       /* the highest power of the position that is stored: 0, 1 or 3 */
  int32_t channel_kind[DVR_TABLE_MOST_CHANNELS], channel_index[DVR_TABLE_MOST_CHANNELS];
  int32_t ratio;
  int32_t stream;                                             /* 1: write past the caches */
  double ratio_noise[DVR_TABLE_MOST_COLUMNS];                 /* > 0: light below it is noise, its ratio goes to 1 */
  const double *length_extinction[3], *surface_extinction[3]; /* per cell, ascending order, without Diracs */
  /* Cells with Dirac terms, ascending: those of Dirac cell q are dirac_first[q] .. dirac_first[q + 1] - 1 */
  int32_t dirac_cells;
  const int32_t *dirac_first, *dirac_at;              /* dirac_at[q]: its cell */
  const double* dirac_u;                              /* position in the cell, ascending */
  const double* dirac_mu[3];                          /* per extinction channel */
  const double* dirac_source[DVR_TABLE_MOST_COLUMNS]; /* colour in the column */
  dvr_table_side side[2];                             /* ascending, descending */
} dvr_table_job;

typedef struct dvr_table_module {
  int32_t abi;
  int32_t lanes; /* m per block, a multiple of 4 */
  /* Bytes of 64-byte aligned memory that one thread needs. */
  size_t (*scratch_bytes)(const dvr_table_job* job);
  /* All entries of both directions with m in [m0, m0 + lanes) whose window of cells meets the cells [first, last) of
   * the ascending order. m0 is a multiple of `lanes`. With m0 = 0 the diagonal is written too. */
  void (*block)(const dvr_table_job* job, void* scratch, int32_t m0, int32_t first, int32_t last);
  /* For tests: e^-x, 1 - e^-x, phi1(x) and psi(x) of x[i] >= 0. */
  void (*functions)(const double* x, int32_t count, double* t, double* opacity, double* phi1, double* psi);
} dvr_table_module;

#ifdef __cplusplus
}
#endif
#endif
