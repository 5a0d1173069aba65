/* SPDX-License-Identifier: MIT */
/* lampion/preintegrated.h - lobes and BRDFs integrated over caps in advance, for shading whose cost
 * does not grow with the number of bands (docs/preintegration.md has the derivation).
 *
 * The integral of a Phong lobe, truncated to n bands and windowed, over a spherical cap of half
 * angle a depends on three numbers: the exponent e, a, and the angle g between the axes of lobe and
 * cap. A preintegrated lobe holds it for every e, a and g, with one n and one windowing filter. A
 * lookup costs the same at 5 bands and at 128.
 *
 * How it is stored
 *   slices   one per exponent e_k. Cell k holds slices k and k+1, interleaved value by value;
 *            between them the value is linear in `remap`, a tabulated function of the exponent.
 *   grid     uniform in g and a, with a step that follows the lobe's width (in a cell, 1 / step =
 *            scale sqrt(e + 1.5) + offset); cubic B-splines in both, 4 x 4 coefficients per lookup.
 *            Row 0 and column 0 are the nodes -1, so that a lookup never leaves the cell.
 *   value    the mean of the lobe over the cap, times the sum of the cap's solid angle and the
 *            lobe's own, which makes it about 1 at the peak for any cap. It has 16 bits.
 *
 * A release build clamps lookups to the table (base.h). */
#ifndef LAMPION_PREINTEGRATED_H
#define LAMPION_PREINTEGRATED_H

#include <lampion/brdf.h>
#include <lampion/lobe.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lmp_preintegrated_lobe lmp_preintegrated_lobe;

/* How to make a preintegrated lobe. Zero-initialize it: zero means a member's default, which its
 * comment names last. */
typedef struct lmp_preintegrated_lobe_desc {
    int bands; /* 1 … LMP_BANDS_MAX; 10 */
    lmp_window window;
    float window_size; /* as in lmp_sh_make_window */
    /* The largest error at exponents >= 1, relative to the largest value over g at that e and a:
     * LMP_PREINTEGRATED_LOBE_ERROR_MIN … 0.1; LMP_PREINTEGRATED_LOBE_ERROR_DEFAULT. A bound above
     * 0.05 may be exceeded by a tenth. Memory grows as 1/error */
    float error;
} lmp_preintegrated_lobe_desc;
#define LMP_PREINTEGRATED_LOBE_ERROR_DEFAULT 0.005f
#define LMP_PREINTEGRATED_LOBE_ERROR_MIN     0.002f

/* Makes a preintegrated lobe. It is immutable: share it freely, and free it with
 * lmp_preintegrated_lobe_destroy.
 *
 * host and desc may be NULL; on failure *lobe is NULL. LMP_ERROR_ARGUMENT: a member of desc is
 * outside its range */
LMP_API lmp_result lmp_preintegrated_lobe_create(const lmp_host *host,
                                                 const lmp_preintegrated_lobe_desc *desc,
                                                 lmp_preintegrated_lobe **lobe);
LMP_API void lmp_preintegrated_lobe_destroy(lmp_preintegrated_lobe *lobe);

/* Returns the response of the lobe with this exponent to a cap of unit strength: the integral of
 * lobe times radiance for pi L sin²a = 1. For an lmp_cap, multiply it by the strength and add the
 * ambient.
 *
 * exponent >= 0; one_minus_cos = 1 - cos a, 0 … 1; cosine, -1 … 1, of the angle between the axes.
 * Below exponent 1 the error bound does not hold: the lobe has a cusp, which is smoothed to within
 * 3 % of the peak. Exponents above LMP_PREINTEGRATED_LOBE_EXPONENT_MAX are treated as equal to it:
 * to within 0.4 % of the peak, 128 bands cannot show sharper lobes */
#define LMP_PREINTEGRATED_LOBE_EXPONENT_MAX 1048575.0f
LMP_API float lmp_preintegrated_lobe_eval(const lmp_preintegrated_lobe *lobe, float exponent,
                                          float one_minus_cos, float cosine);

/* --- for a graphics API or a kernel of your own ----------------------------------------------- */

/* The grid of a cell's coefficients: rows along a, columns along g. */
typedef struct lmp_preintegrated_lobe_cell {
    float scale, offset;    /* 1/step = scale sqrt(e + 1.5) + offset, radians */
    uint32_t first;         /* index of its first pair of coefficients */
    uint32_t rows, columns; /* of pairs: `columns` per row, tight */
} lmp_preintegrated_lobe_cell;

/* The contents of a preintegrated lobe. `coefficients` holds pairs, one value from each of two
 * slices, in units of LMP_PREINTEGRATED_LOBE_UNIT; remap[i] is the slice coordinate (cell +
 * fraction of the second slice) at bits(1 + e) = bits(1) + (i << 19), to be interpolated linearly:
 * 16 entries per octave of 1 + e. */
typedef struct lmp_preintegrated_lobe_info {
    int bands;
    lmp_window window;
    float window_size;
    float error;
    uint32_t cell_count;
    const lmp_preintegrated_lobe_cell *cells;
    const int16_t *coefficients;
    size_t pair_count;
    const float *remap; /* LMP_PREINTEGRATED_LOBE_REMAP_COUNT entries */
    float width2;       /* 1 / bands²: the lobe's own solid angle is pi (1/(e + 1) + width2) */
    size_t bytes;       /* of memory it holds */
} lmp_preintegrated_lobe_info;
#define LMP_PREINTEGRATED_LOBE_UNIT        (2.0f / 32767.0f)
#define LMP_PREINTEGRATED_LOBE_REMAP_COUNT (20 * 16 + 1)
LMP_EXPERIMENTAL LMP_API lmp_preintegrated_lobe_info
lmp_preintegrated_lobe_describe(const lmp_preintegrated_lobe *lobe);

/* --- as bytes ------------------------------------------------------------------------------------
 * Write a preintegrated lobe as bytes and read it back: little-endian, versioned, checksummed. A
 * lobe gives the same bytes on every machine.
 *
 * size must be at least lmp_preintegrated_lobe_size(lobe): otherwise nothing is written and the
 * result is LMP_ERROR_ARGUMENT */
LMP_API size_t lmp_preintegrated_lobe_size(const lmp_preintegrated_lobe *lobe);
LMP_API lmp_result lmp_preintegrated_lobe_write(const lmp_preintegrated_lobe *lobe, size_t size,
                                                void *bytes);
LMP_API lmp_result lmp_preintegrated_lobe_read(const lmp_host *host, const void *data, size_t size,
                                               lmp_parse_error *error,
                                               lmp_preintegrated_lobe **lobe);

/* --- BRDFs ---------------------------------------------------------------------------------------
 * The integral of an isotropic BRDF's table over a cap depends on four numbers: the angle of the
 * view, a, and the two angles of the cap's axis in the frame of the view.
 *
 * How it is stored
 *   slices   one for each pair of a view and a half angle; between them the value is linear in the
 *            coordinates that view_remap and cap_remap tabulate.
 *   grid     of a slice: polar around the mirror direction, g being the angle to it and p the
 *            azimuth around it, from the side of the normal. Rows are counted from the rim of the
 *            cap, so that the rim lies on the same row in every slice:
 *                x      = g - a² / (sqrt(a² + radius²) + radius)
 *                s      = x (reach / width / sqrt(x² + reach²) + slope)
 *                row    = s row_density - row_origin
 *                column = p column_density + 1
 *            Cubic B-splines in both, 4 x 4 coefficients per lookup, the second each way at the
 *            integer part of row and column.
 *   value    the mean over the cap of BRDF times cosine, times the sum of the cap's solid angle and
 *            lobe_angle. Red, green and blue have 16 bits each. */
typedef struct lmp_preintegrated_brdf lmp_preintegrated_brdf;

/* How to make a preintegrated BRDF. Zero-initialize it: zero means a member's default, which its
 * comment names last. */
typedef struct lmp_preintegrated_brdf_desc {
    /* The largest error, as in lmp_preintegrated_lobe_desc, but relative to the largest value of
     * any channel over all directions at that view and a, or to a twentieth of the largest over all
     * views if that is more. */
    float error;
    size_t bytes_max; /* more is LMP_ERROR_MEMORY; LMP_PREINTEGRATED_BRDF_BYTES_MAX */
} lmp_preintegrated_brdf_desc;
#define LMP_PREINTEGRATED_BRDF_BYTES_MAX ((size_t)1 << 27)

/* Integrates the table of a BRDF over caps. The result is immutable: share it freely, and free it
 * with lmp_preintegrated_brdf_destroy. The table is not kept.
 *
 * host and desc may be NULL; on failure *brdf is NULL. LMP_ERROR_ARGUMENT: a member of desc is
 * outside its range, or the table is anisotropic: the azimuth of the view would be a fifth number.
 * LMP_ERROR_MEMORY: memory ran out, or the result would be larger than bytes_max.
 *
 * Making one takes several times the memory of the result: at 100 bands from about 210 MB (steel,
 * whose result takes 59 MB) to 290 MB (red fabric, 47 MB), plus about 12 MB per thread. */
LMP_API lmp_result lmp_preintegrated_brdf_create(const lmp_host *host,
                                                 const lmp_preintegrated_brdf_desc *desc,
                                                 const lmp_brdf_table *table,
                                                 lmp_preintegrated_brdf **brdf);
LMP_API void lmp_preintegrated_brdf_destroy(lmp_preintegrated_brdf *brdf);

/* Returns the response of the table to a cap of unit strength, as lmp_preintegrated_lobe_eval does
 * for a lobe. It is not clamped.
 *
 * cos_theta_o is clamped to 0 … 1; axis must be unit, in the frame of the view (brdf.h);
 * one_minus_cos = 1 - cos a, 0 … 1 */
LMP_API lmp_rgb lmp_preintegrated_brdf_eval(const lmp_preintegrated_brdf *brdf, float cos_theta_o,
                                            lmp_vec3 axis, float one_minus_cos);

/* Returns the response of the table to ambient radiance 1: multiply it by a cap's ambient. */
LMP_API lmp_rgb lmp_preintegrated_brdf_ambient(const lmp_preintegrated_brdf *brdf,
                                               float cos_theta_o);

/* A slice of a preintegrated BRDF: rows times columns texels from `first` on. */
typedef struct lmp_preintegrated_brdf_slice {
    uint32_t first;
    uint32_t rows, columns; /* of texels: `columns` per row, tight; at least 4 by 4 */
    float row_density, row_origin, column_density;
    float unit; /* the value that a texel of 1 stands for */
} lmp_preintegrated_brdf_slice;

/* The contents of a preintegrated BRDF. A slice coordinate is the index of the first of two slices
 * plus the fraction of the second. A remap holds it at i / steps, to be interpolated linearly,
 * where i / steps is
 *   view_remap   theta_o / (pi/2)
 *   cap_remap    a / (a + 0.5), divided by its value at a = pi/2 */
typedef struct lmp_preintegrated_brdf_info {
    int bands; /* bands and window are the table's */
    lmp_window window;
    float window_size;
    float error;
    bool mirrored;                  /* only azimuths 0 … pi; otherwise 0 … 2 pi */
    float width, radius;            /* radians: width of the finest detail, radius of the lobe */
    float reach;                    /* radians */
    float slope;                    /* 1/radians */
    float lobe_angle;               /* sr */
    uint32_t view_count, cap_count; /* of slices, at least 2 */
    uint32_t view_steps, cap_steps;
    const float *view_remap, *cap_remap;        /* steps + 1 */
    const lmp_rgb *ambient;                     /* one per view */
    const lmp_preintegrated_brdf_slice *slices; /* [view][cap] */
    const int16_t *texels;                      /* red, green, blue */
    size_t texel_count;
    size_t bytes; /* of memory it holds */
} lmp_preintegrated_brdf_info;
LMP_EXPERIMENTAL LMP_API lmp_preintegrated_brdf_info
lmp_preintegrated_brdf_describe(const lmp_preintegrated_brdf *brdf);

/* Write a preintegrated BRDF as bytes and read it back: little-endian, versioned, checksummed. A
 * BRDF gives the same bytes on every machine.
 *
 * size must be at least lmp_preintegrated_brdf_size(brdf): otherwise nothing is written and the
 * result is LMP_ERROR_ARGUMENT */
LMP_API size_t lmp_preintegrated_brdf_size(const lmp_preintegrated_brdf *brdf);
LMP_API lmp_result lmp_preintegrated_brdf_write(const lmp_preintegrated_brdf *brdf, size_t size,
                                                void *bytes);
LMP_API lmp_result lmp_preintegrated_brdf_read(const lmp_host *host, const void *data, size_t size,
                                               lmp_parse_error *error,
                                               lmp_preintegrated_brdf **brdf);

#ifdef __cplusplus
}
#endif
#endif
