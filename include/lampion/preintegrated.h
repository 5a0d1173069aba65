/* SPDX-License-Identifier: MIT */
/* lampion/preintegrated.h - lobes and BRDFs integrated against caps beforehand: shading whose cost
 * does not grow with the bands (docs/preintegration.md derives it).
 *
 * The integral of a Phong lobe, truncated to n bands and windowed, over a spherical cap of half
 * angle a depends on three numbers: the exponent e, a, and the angle g between the axes of lobe and
 * cap. A preintegrated lobe holds it for every e, a, g at one n and filter. Reading costs the same
 * at 5 bands and at 128.
 *
 * How it is stored
 *   slices   exponents e_k. Cell k holds slices k and k+1, value by value interleaved; between them
 *            the value is linear in `remap`, a table of the exponent.
 *   grid     uniform in g and a at a step that follows the lobe's width (cell: 1 / step =
 *            scale sqrt(e + 1.5) + offset); cubic B-splines in both, 4 x 4 coefficients a reading.
 *            Row 0 and column 0 are the nodes -1, so that a reading never leaves the cell.
 *   value    mean of the lobe over the cap, times the cap's solid angle plus the lobe's own, which
 *            makes it about 1 at the peak for any cap. 16 bits.
 *
 * A release build clamps what it looks up to the table (base.h). */
#ifndef LAMPION_PREINTEGRATED_H
#define LAMPION_PREINTEGRATED_H

#include <lampion/brdf.h>
#include <lampion/lobe.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lmp_preintegrated_lobe lmp_preintegrated_lobe;

/* How to make one; zero-initialize it, zero means the default. */
typedef struct lmp_preintegrated_lobe_desc {
    int bands; /* 1 … LMP_BANDS_MAX; 10 */
    lmp_window window;
    float window_size; /* as in lmp_sh_window */
    /* Largest error at exponents >= 1, relative to the largest value over g at that e and a:
     * LMP_PREINTEGRATED_LOBE_ERROR_MIN … 0.1; LMP_PREINTEGRATED_LOBE_ERROR_DEFAULT. Above 0.05 the
     * bound may be exceeded by a tenth. Memory grows as 1/error */
    float error;
} lmp_preintegrated_lobe_desc;
#define LMP_PREINTEGRATED_LOBE_ERROR_DEFAULT 0.005f
#define LMP_PREINTEGRATED_LOBE_ERROR_MIN     0.002f

/* host and desc may be NULL; *lobe is NULL on failure. LMP_ERROR_ARGUMENT: a member
 * outside its range. Immutable: share it freely. */
LMP_API lmp_result lmp_preintegrated_lobe_create(const lmp_host *host,
                                                 const lmp_preintegrated_lobe_desc *desc,
                                                 lmp_preintegrated_lobe **lobe);
LMP_API void lmp_preintegrated_lobe_destroy(lmp_preintegrated_lobe *lobe);

/* The response of the lobe of `exponent` to a cap of unit strength: the integral of lobe times
 * radiance where pi L sin²a = 1 (lmp_cap: multiply by its strength, add its ambient).
 *
 * exponent >= 0; one_minus_cos = 1 - cos a, 0 … 1; cosine of the angle between the axes, -1 … 1.
 * Below exponent 1 the error bound does not hold: the lobe has a cusp, smoothed to 3 % of its
 * peak. Exponents above LMP_PREINTEGRATED_LOBE_EXPONENT_MAX are read as that: sharper than 128
 * bands show, but for 0.4 % of the peak */
#define LMP_PREINTEGRATED_LOBE_EXPONENT_MAX 1048575.0f
LMP_API float lmp_preintegrated_lobe_eval(const lmp_preintegrated_lobe *lobe, float exponent,
                                          float one_minus_cos, float cosine);

/* --- for a graphics API or a kernel of your own ----------------------------------------------- */

/* Where a cell lies: rows of a, columns of g. */
typedef struct lmp_preintegrated_lobe_cell {
    float scale, offset;    /* 1/step = scale sqrt(e + 1.5) + offset, radians */
    uint32_t first;         /* of its coefficients, in pairs */
    uint32_t rows, columns; /* pairs: `columns` a row, tight */
} lmp_preintegrated_lobe_cell;

/* What it is made of. `coefficients` are pairs of slices in units of LMP_PREINTEGRATED_LOBE_UNIT;
 * remap[i] is the slice coordinate (cell + fraction of the second slice) at bits(1 + e) = bits(1) +
 * i << 19, linear between: 16 entries an octave of 1 + e. */
typedef struct lmp_preintegrated_lobe_info {
    int bands;
    lmp_window window;
    float window_size;
    float error;
    uint32_t cell_count;
    const lmp_preintegrated_lobe_cell *cells;
    const int16_t *coefficients;
    size_t pair_count;
    const float *remap; /* LMP_PREINTEGRATED_LOBE_REMAP_COUNT */
    float width2;       /* 1 / bands²: the lobe's own solid angle is pi (1/(e + 1) + width2) */
    size_t bytes;       /* of all that */
} lmp_preintegrated_lobe_info;
#define LMP_PREINTEGRATED_LOBE_UNIT        (2.0f / 32767.0f)
#define LMP_PREINTEGRATED_LOBE_REMAP_COUNT (20 * 16 + 1)
LMP_API lmp_preintegrated_lobe_info
lmp_preintegrated_lobe_describe(const lmp_preintegrated_lobe *lobe);

/* --- as bytes ------------------------------------------------------------------------------------
 * Little-endian, versioned, checksummed; the same bytes from the same lobe on any machine.
 *
 * bytes receives lmp_preintegrated_lobe_size(lobe) bytes */
LMP_API size_t lmp_preintegrated_lobe_size(const lmp_preintegrated_lobe *lobe);
LMP_API void lmp_preintegrated_lobe_write(const lmp_preintegrated_lobe *lobe, void *bytes);
LMP_API lmp_result lmp_preintegrated_lobe_read(const lmp_host *host, const void *data, size_t size,
                                               lmp_preintegrated_lobe **lobe);

/* --- BRDFs ---------------------------------------------------------------------------------------
 * The integral of an isotropic BRDF's table over a cap depends on four numbers: the angle of the
 * view, a, and the direction of the cap's axis in the frame of the view.
 *
 * How it is stored
 *   slices   of a view and a half angle each; between them the value is linear in the coordinates
 *            view_remap and cap_remap.
 *   grid     of a slice: polar about the mirror direction, g the angle to it, p the azimuth around
 *            it from the side of the normal. Rows are counted from where the cap's rim shows, so
 *            that the rim lies on the same row in every slice:
 *                x      = g - a² / (sqrt(a² + radius²) + radius)
 *                s      = x (reach / width / sqrt(x² + reach²) + slope)
 *                row    = s row_density - row_origin
 *                column = p column_density + 1
 *            Cubic B-splines in both, 4 x 4 coefficients a reading, the second of them at the whole
 *            part of row and column.
 *   value    mean over the cap of BRDF times cosine, times the cap's solid angle plus lobe_angle.
 *            Red, green, blue in 16 bits each. */
typedef struct lmp_preintegrated_brdf lmp_preintegrated_brdf;

/* How to make one; zero-initialize it, zero means the default. */
typedef struct lmp_preintegrated_brdf_desc {
    /* As in lmp_preintegrated_lobe_desc, relative to the largest value, of any channel, over all
     * directions at that view and a, or to a twentieth of all views' */
    float error;
    size_t bytes_max; /* a larger one is LMP_ERROR_MEMORY; LMP_PREINTEGRATED_BRDF_BYTES_MAX */
} lmp_preintegrated_brdf_desc;
#define LMP_PREINTEGRATED_BRDF_BYTES_MAX ((size_t)1 << 27)

/* host and desc may be NULL; *brdf is NULL on failure. The table is not kept.
 * LMP_ERROR_ARGUMENT: a member outside its range, or an anisotropic table: its azimuth of the view
 * would be a fifth number. LMP_ERROR_MEMORY: no memory, or it would be larger
 * than bytes_max. Immutable: share it freely.
 *
 * Making one takes several times its memory: at 100 bands about 210 MB (steel, 59 MB made) to 290
 * (red fabric, 47), and about 12 more a thread. */
LMP_API lmp_result lmp_preintegrated_brdf_create(const lmp_host *host,
                                                 const lmp_preintegrated_brdf_desc *desc,
                                                 const lmp_brdf_table *table,
                                                 lmp_preintegrated_brdf **brdf);
LMP_API void lmp_preintegrated_brdf_destroy(lmp_preintegrated_brdf *brdf);

/* The response of the table to a cap of unit strength, as lmp_preintegrated_lobe_eval; not clamped.
 *
 * cos_theta_o is clamped to 0 … 1; axis is unit, in the frame of the view (brdf.h); one_minus_cos =
 * 1 - cos a, 0 … 1 */
LMP_API lmp_rgb lmp_preintegrated_brdf_eval(const lmp_preintegrated_brdf *brdf, float cos_theta_o,
                                            lmp_vec3 axis, float one_minus_cos);

/* The same to ambient radiance 1: multiply by a cap's ambient. */
LMP_API lmp_rgb lmp_preintegrated_brdf_ambient(const lmp_preintegrated_brdf *brdf,
                                               float cos_theta_o);

/* One slice: rows times columns texels from `first` on. */
typedef struct lmp_preintegrated_brdf_slice {
    uint32_t first;
    uint32_t rows, columns; /* texels: `columns` a row, tight; at least 4 by 4 */
    float row_density, row_origin, column_density;
    float unit; /* of its values */
} lmp_preintegrated_brdf_slice;

/* What it is made of. A coordinate is the index of the first of two slices plus the fraction of
 * the second; a remap holds it at i / steps, linear between, of
 *   view_remap   theta_o / (pi/2)
 *   cap_remap    a / (a + 0.5), over the same of pi/2 */
typedef struct lmp_preintegrated_brdf_info {
    int bands; /* and window: of the table */
    lmp_window window;
    float window_size;
    float error;
    bool mirrored;                  /* azimuths 0 … pi alone; otherwise 0 … 2 pi */
    float width, radius;            /* radians: of the finest detail, of the lobe */
    float reach;                    /* radians */
    float slope;                    /* 1/radians */
    float lobe_angle;               /* sr */
    uint32_t view_count, cap_count; /* of slices, 2 and up */
    uint32_t view_steps, cap_steps;
    const float *view_remap, *cap_remap;        /* steps + 1 */
    const lmp_rgb *ambient;                     /* of every view */
    const lmp_preintegrated_brdf_slice *slices; /* [view][cap] */
    const int16_t *texels;                      /* red, green, blue */
    size_t texel_count;
    size_t bytes; /* of all that */
} lmp_preintegrated_brdf_info;
LMP_API lmp_preintegrated_brdf_info
lmp_preintegrated_brdf_describe(const lmp_preintegrated_brdf *brdf);

/* As bytes, like lmp_preintegrated_lobe_write and lmp_preintegrated_lobe_read. */
LMP_API size_t lmp_preintegrated_brdf_size(const lmp_preintegrated_brdf *brdf);
LMP_API void lmp_preintegrated_brdf_write(const lmp_preintegrated_brdf *brdf, void *bytes);
LMP_API lmp_result lmp_preintegrated_brdf_read(const lmp_host *host, const void *data, size_t size,
                                               lmp_preintegrated_brdf **brdf);

#ifdef __cplusplus
}
#endif
#endif
