/* SPDX-License-Identifier: MIT */
/* gradient.h - accumulate.h with position derivatives:
 *
 *     grad L_lm = (pi s2/d) [ (2 P_l(alpha)/alpha) Y_lm w - R_l gradT Y_lm ]
 *
 * With g the gradient of the polynomial Y_lm, gradT Y = g - (g·w) w and, for m > 0,
 * g·w = (m q + z q') {C_m, S_m}; so with A = (2 P_l/alpha) q + R_l (m q + z q') and B = R_l q
 *
 *     d/dx = A x C_m - B m C_(m-1)     d/dy = A y C_m + B m S_(m-1)     d/dz = (A z - R_l q') C_m
 *
 * and for -m the same with S_m, S_(m-1) and -C_(m-1). q' is the column m + 1 (tables.h, slope), so
 * columns run downwards. */
#ifndef LAMPION_KERNELS_GRADIENT_H
#define LAMPION_KERNELS_GRADIENT_H

#include "src/kernels/accumulate.h"

/* Planes of one (l, m): value, d/dx, d/dy, d/dz, each red, green, blue; of +m, then of -m. */
#define GRADIENT_WIDTH 24

/* Pairs (l, m) of a tile, 36 KiB of sums and less; and the most columns that they make. */
#define GRADIENT_PAIRS   (LMP_LANES > 2 ? 384 / LMP_LANES : LMP_BANDS_MAX)
#define GRADIENT_COLUMNS 16

/* Lights a pass. */
#define GRADIENT_LIGHTS 2

/* What a band needs lies together: arrays of as many registers begin in one set of the first cache,
 * and there are more of them here than ways. */
typedef struct gradient_band {
    vf value;  /* pi s2 R_l */
    vf across; /* (pi s2/d) R_l */
    vf along;  /* (pi s2/d) 2 P_l/alpha */
} gradient_band;

/* The tile after this one: of few bands whole bands, which lie together in rows and need the light
 * less often than columns do; of more, columns, whose recurrences begin with them. */
static inline accumulate_tile gradient_next(int bands, accumulate_tile tile) {
    if (bands > GRADIENT_COLUMNS)
        return accumulate_next(bands, tile, GRADIENT_PAIRS);
    int high = tile.high + 1, pairs = high;
    if (tile.high == bands)
        return (accumulate_tile) { .first = bands };
    while (high < bands && pairs + high + 1 <= GRADIENT_PAIRS)
        pairs += ++high;
    return (accumulate_tile) { 0, high, tile.high, high };
}

static inline accumulate_tile gradient_first(int bands) {
    return bands > GRADIENT_COLUMNS ? accumulate_first(bands, GRADIENT_PAIRS)
                                    : gradient_next(bands, (accumulate_tile) { 0 });
}

/* What of a light a tile needs: bands from its lowest on, and C_m, S_m from before its first. */
typedef struct gradient_light {
    vf x, y, z;
    lmp_rgb rgb;
    gradient_band band[GRADIENT_PAIRS];
    vf c[GRADIENT_COLUMNS + 1], s[GRADIENT_COLUMNS + 1];
} gradient_light;

/* q of one (l, m), and of (l, m + 1). */
typedef struct gradient_pair {
    vf q[2][GRADIENT_LIGHTS];
} gradient_pair;

static inline void gradient_rotate(accumulate_tile tile, gradient_light *light) {
    vf c = vf_set(1), s = vf_set(0);
    light->c[0] = light->s[0] = vf_set(0); /* of m = -1, multiplied by 0 */
    for (int m = 0; m < tile.end; m++) {
        if (m > 0)
            basis_rotate(m, light->x, light->y, &c, &s);
        if (m + 1 >= tile.first) {
            light->c[m + 1 - tile.first] = c;
            light->s[m + 1 - tile.first] = s;
        }
    }
}

/* R_l twice, for its factor is in it from the start; all by differences (cap.h). Parity: R_l
 * changes sign inside with even l, P_l with odd. */
static inline void gradient_bands(accumulate_tile tile, const cap_lanes *cap, float cos_min,
                                  gradient_band *bands) {
    const vf per_distance = LMP_KERNEL_PI * cap->s2_per_d;
    const vf outward = (per_distance + per_distance) / vf_max(cap->alpha, vf_set(cos_min));
    vf value = vf_set(LMP_KERNEL_PI) * cap->s2, value_difference = vf_set(0);
    vf r = per_distance, r_difference = vf_set(0), p = vf_set(1), p_difference = vf_set(0);
    if (tile.low == 0) {
        const vf pi = vf_set(LMP_KERNEL_PI);
        bands[0] = (gradient_band) { (pi + pi) * cap->t_full, vf_set(0), outward };
    }
    for (int l = 1; l < tile.high; l++) {
        if (l > 1) {
            value_difference =
                lmp_table_cap_d[l] * value_difference - lmp_table_cap_t[l] * cap->t * value;
            value = value + value_difference;
            r_difference = lmp_table_cap_d[l] * r_difference - lmp_table_cap_t[l] * cap->t * r;
            r = r + r_difference;
        }
        p_difference =
            lmp_table_legendre_d[l] * p_difference - lmp_table_legendre_t[l] * cap->t * p;
        p = p + p_difference;
        if (l >= tile.low)
            bands[l - tile.low] =
                l % 2 ? (gradient_band) { value, r, outward * (p * cap->even) }
                      : (gradient_band) { value * cap->even, r * cap->even, outward * p };
    }
}

static inline void gradient_prepare(accumulate_tile tile, const lmp_kernel_lights *lights, size_t i,
                                    const vf point[3], float cos_min, gradient_light *light) {
    cap_lanes cap = lights_cap(lights, i, point, 1);
    cap_axis(&cap);
    light->x = cap.x;
    light->y = cap.y;
    light->z = cap.z;
    light->rgb = lights_radiance(lights, i);
    gradient_rotate(tile, light);
    gradient_bands(tile, &cap, cos_min, light->band);
}

/* Column m of light k in the tile's bands. */
static inline void gradient_column(accumulate_tile tile, int m, vf z, gradient_pair *pairs, int k) {
    vf q0 = vf_set(0), q1 = vf_set(lmp_table_diagonal[m]);
    if (m >= tile.low)
        pairs[m - tile.low].q[m % 2][k] = q1;
    for (int l = m + 1; l < tile.high; l++) {
        const vf q2 = basis_step(lmp_table_a, lmp_table_b, l, m, z, q1, q0);
        q0 = q1;
        q1 = q2;
        if (l >= tile.low)
            pairs[l - tile.low].q[m % 2][k] = q1;
    }
}

/* (l, m) for one light: of +m the value, d/dx, d/dy, d/dz, then of -m. */
LMP_INLINE void gradient_entry(accumulate_tile tile, const gradient_light *light, int l, int m,
                               vf q, vf slope, vf term[8]) {
    const gradient_band *band = &light->band[l - tile.low];
    const int column = m - tile.first;
    const vf c = light->c[column + 1], s = light->s[column + 1];
    const vf x = light->x, y = light->y, z = light->z;
    const vf mc = (float)m * light->c[column], ms = (float)m * light->s[column];
    const vf across = band->across * q, tilt = band->across * slope;
    const vf along = band->along * q + (float)m * across + z * tilt;
    const vf value = band->value * q, up = z * along - tilt;
    term[0] = value * c;
    term[1] = x * c * along - mc * across;
    term[2] = y * c * along + ms * across;
    term[3] = c * up;
    term[4] = value * s;
    term[5] = x * s * along - ms * across;
    term[6] = y * s * along - mc * across;
    term[7] = s * up;
}

/* The sums of a column follow those of the column below it. */
LMP_INLINE void gradient_columns(accumulate_tile tile, int at_once, const gradient_light *light,
                                 vf *sums) {
    gradient_pair pairs[GRADIENT_PAIRS];
    for (int k = 0; tile.end < tile.high && k < at_once; k++)
        gradient_column(tile, tile.end, light[k].z, pairs, k);
    sums += accumulate_pairs(tile) * GRADIENT_WIDTH;
    for (int m = tile.end - 1; m >= tile.first; m--) {
        for (int k = 0; k < at_once; k++)
            gradient_column(tile, m, light[k].z, pairs, k);
        const int low = m > tile.low ? m : tile.low;
        sums -= (tile.high - low) * GRADIENT_WIDTH;
        const float *slopes = lmp_table_slope + lmp_table_index(m, m);
        for (int l = low; l < tile.high; l++) {
            vf *sum = sums + (l - low) * GRADIENT_WIDTH, term[GRADIENT_LIGHTS][8];
            const gradient_pair *pair = &pairs[l - tile.low];
            LMP_UNROLL for (int k = 0; k < at_once; k++)
                gradient_entry(tile, &light[k], l, m, pair->q[m % 2][k],
                               l > m ? slopes[l - m] * pair->q[1 - m % 2][k] : vf_set(0), term[k]);
            LMP_UNROLL for (int i = 0; i < 8; i++) {
                if (m == 0 && i == 4)
                    break;
                LMP_UNROLL for (int k = 0; k < at_once; k++) {
                    sum[3 * i] = sum[3 * i] + light[k].rgb.r * term[k][i];
                    sum[3 * i + 1] = sum[3 * i + 1] + light[k].rgb.g * term[k][i];
                    sum[3 * i + 2] = sum[3 * i + 2] + light[k].rgb.b * term[k][i];
                }
            }
        }
    }
}

static LMP_NOINLINE void gradient_tile(accumulate_tile tile, const lmp_kernel_lights *lights,
                                       const vf point[3], float cos_min, vf *sums) {
    gradient_light light[GRADIENT_LIGHTS];
    size_t i = 0;
    for (; i + GRADIENT_LIGHTS <= lights->count; i += GRADIENT_LIGHTS) {
        for (size_t k = 0; k < GRADIENT_LIGHTS; k++)
            gradient_prepare(tile, lights, i + k, point, cos_min, &light[k]);
        gradient_columns(tile, GRADIENT_LIGHTS, light, sums);
    }
    for (; i < lights->count; i++) {
        gradient_prepare(tile, lights, i, point, cos_min, &light[0]);
        gradient_columns(tile, 1, light, sums);
    }
}

static LMP_NOINLINE void gradient_put(int bands, accumulate_tile tile, const vf *sums,
                                      const lmp_kernel_out *out, const lmp_kernel_out *gradient,
                                      size_t element, size_t live) {
    const accumulate_sets values = { 12, 0, 3 }, slopes = { 12, 3, 9 };
    vf waiting[ACCUMULATE_WAITING];
    accumulate_put(bands, tile, 0, values, sums, waiting, out, element, live);
    accumulate_put(bands, tile, 0, slopes, sums, waiting, gradient, element, live);
}

static void kernel_gradient(int bands, const lmp_kernel_lights *lights,
                            const lmp_kernel_vec3 *points, float cos_min, size_t count,
                            const lmp_kernel_out *out, const lmp_kernel_out *gradient) {
    vf sums[GRADIENT_PAIRS * GRADIENT_WIDTH];
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const vf point[3] = { vf_load(points->x + e), vf_load(points->y + e),
                              vf_load(points->z + e) };
        const size_t live = layout_live(count, e);
        for (accumulate_tile tile = gradient_first(bands); tile.first < bands;
             tile = gradient_next(bands, tile)) {
            memset(sums, 0, accumulate_pairs(tile) * GRADIENT_WIDTH * sizeof *sums);
            gradient_tile(tile, lights, point, cos_min, sums);
            gradient_put(bands, tile, sums, out, gradient, e, live);
        }
    }
}

#endif
