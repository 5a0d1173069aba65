/* SPDX-License-Identifier: MIT */
/* gradient_tmpl.h - accumulate_tmpl.h with position derivatives:
 *
 *     grad L_lm = (pi s2/d) [ (2 P_l(alpha)/alpha) Y_lm w - R_l gradT Y_lm ]
 *
 * With g the gradient of the polynomial Y_lm, gradT Y = g - (g·w) w and, for m > 0,
 * g·w = (m q + z q') {C_m, S_m}; so with A = (2 P_l/alpha) q + R_l (m q + z q') and B = R_l q
 *
 *     d/dx = A x C_m - B m C_(m-1)     d/dy = A y C_m + B m S_(m-1)     d/dz = (A z - R_l q') C_m
 *
 * and for -m the same with S_m, S_(m-1) and -C_(m-1). q' is the column m + 1 (tables.h, slope),
 * which runs beside column m. */
#ifndef LAMPION_KERNELS_GRADIENT_TMPL_H
#define LAMPION_KERNELS_GRADIENT_TMPL_H

#include "src/kernels/accumulate_tmpl.h"
#include "src/kernels/fade_tmpl.h"
#include "src/kernels/light.h"

/* Planes of one (l, m): value, d/dx, d/dy, d/dz, each red, green, blue, for +m and then for -m. */
#define GRADIENT_WIDTH 24

/* The factors of one light in one band. */
typedef struct gradient_band {
    vf value;  /* pi s2 R_l */
    vf across; /* (pi s2/d) R_l */
    vf along;  /* (pi s2/d) 2 P_l/alpha */
    vf q[2];   /* q of the even column and of the odd one */
} gradient_band;

/* The recurrences of the factors, by differences (cap_tmpl.h); R_l is run twice, because its factor
 * is in it from the start. */
typedef struct gradient_series {
    vf t, even, outward;
    vf value, value_difference, r, r_difference, p, p_difference;
} gradient_series;

/* A light's axis, with C, S of the column before and of this column. */
typedef struct gradient_light {
    vf x, y, z;
    vf c_before, s_before, c, s;
    lmp_rgb rgb;
} gradient_light;

/* Begins a light at column 0 and band 0; m = -1 needs nothing, because it is multiplied by 0. */
LMPI_INLINE gradient_band gradient_begin(const lmpi_kernel_lights *lights, size_t i,
                                         const vf point[3], float cos_min, gradient_light *light,
                                         gradient_series *series) {
    const vf pi = vf_set(LMPI_KERNEL_PI), zero = vf_set(0), one = vf_set(1);
    cap_lanes cap = lights_cap(lights, i, point, 1);
    cap_axis(&cap);
    const vf per_distance = LMPI_KERNEL_PI * cap.s2_per_d;
    const vf outward = (per_distance + per_distance) / vf_max(cap.alpha, vf_set(cos_min));
    *light =
        (gradient_light) { cap.x, cap.y, cap.z, zero, zero, one, zero, lights_radiance(lights, i) };
    *series = (gradient_series) { cap.t,        cap.even, outward, pi * cap.s2, zero,
                                  per_distance, zero,     one,     zero };
    return (gradient_band) { (pi + pi) * cap.t_full, zero, outward, { zero, zero } };
}

/* Advances from band l - 1 to band l. By parity, inside the sphere R_l changes sign with even l,
 * P_l with odd. */
LMPI_INLINE void gradient_series_step(int l, gradient_series *s, gradient_band *band) {
    if (l > 1) {
        const float d = lmpi_table_cap_d[l], t = lmpi_table_cap_t[l];
        s->value_difference = d * s->value_difference - t * s->t * s->value;
        s->value = s->value + s->value_difference;
        s->r_difference = d * s->r_difference - t * s->t * s->r;
        s->r = s->r + s->r_difference;
    }
    s->p_difference =
        lmpi_table_legendre_d[l] * s->p_difference - lmpi_table_legendre_t[l] * s->t * s->p;
    s->p = s->p + s->p_difference;
    const int even = l % 2 == 0;
    band->value = even ? s->value * s->even : s->value;
    band->across = even ? s->r * s->even : s->r;
    band->along = s->outward * (even ? s->p : s->p * s->even);
}

LMPI_INLINE void gradient_rotate(int m, gradient_light *light) {
    light->c_before = light->c;
    light->s_before = light->s;
    basis_rotate(m, light->x, light->y, &light->c, &light->s);
}

/* Advances lights to a tile's first column, and computes the factors of its bands, light k's at
 * bands[at_once * (l - low) + k]. */
LMPI_INLINE void gradient_prepare(accumulate_tile tile, int at_once,
                                  const lmpi_kernel_lights *lights, size_t first, const vf point[3],
                                  float cos_min, gradient_light *light, gradient_band *bands) {
    gradient_series series[ACCUMULATE_LIGHTS];
    LMPI_UNROLL for (int k = 0; k < at_once; k++) bands[k] =
        gradient_begin(lights, first + (size_t)k, point, cos_min, &light[k], &series[k]);
    LMPI_ROLLED for (int m = 1; m <= tile.first; m++) LMPI_UNROLL for (int k = 0; k < at_once; k++)
        gradient_rotate(m, &light[k]);
    LMPI_ROLLED for (int l = 1; l < tile.high; l++) {
        gradient_band *band = bands + (l > tile.low ? at_once * (l - tile.low) : 0);
        LMPI_UNROLL for (int k = 0; k < at_once; k++) gradient_series_step(l, &series[k], &band[k]);
    }
}

/* Computes q of column m in the tile's bands. */
LMPI_INLINE void gradient_column(accumulate_tile tile, int m, int at_once,
                                 const gradient_light *light, gradient_band *bands) {
    vf q0[ACCUMULATE_LIGHTS], q1[ACCUMULATE_LIGHTS];
    LMPI_UNROLL for (int k = 0; k < at_once; k++) {
        q0[k] = vf_set(0);
        q1[k] = vf_set(lmpi_table_diagonal[m]);
    }
    for (int l = m; l < tile.high; l++) {
        if (l > m)
            LMPI_UNROLL for (int k = 0; k < at_once; k++) {
                const vf q = basis_step(lmpi_table_a, lmpi_table_b, l, m, light[k].z, q1[k], q0[k]);
                q0[k] = q1[k];
                q1[k] = q;
            }
        if (l >= tile.low)
            LMPI_UNROLL for (int k = 0; k < at_once; k++) bands[at_once * (l - tile.low) + k]
                .q[m % 2] = q1[k];
    }
}

/* Computes (l, m) for one light: value, d/dx, d/dy, d/dz of +m, then of -m. */
LMPI_INLINE void gradient_entry(const gradient_light *light, const gradient_band *band, int m, vf q,
                                vf slope, vf term[8]) {
    const vf c = light->c, s = light->s;
    const vf x = light->x, y = light->y, z = light->z;
    const vf mc = (float)m * light->c_before, ms = (float)m * light->s_before;
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

/* Adds a column of a tile to its sums. */
LMPI_INLINE vf *gradient_column_add(accumulate_tile tile, int m, int at_once,
                                    const gradient_light *light, const gradient_band *bands,
                                    vf *sums) {
    const float *slopes = lmpi_table_slope + lmpi_table_index(m, m);
    for (int l = m > tile.low ? m : tile.low; l < tile.high; l++) {
        const gradient_band *band = bands + at_once * (l - tile.low);
        vf term[ACCUMULATE_LIGHTS][8];
        LMPI_UNROLL for (int k = 0; k < at_once; k++)
            gradient_entry(&light[k], &band[k], m, band[k].q[m % 2],
                           l > m ? slopes[l - m] * band[k].q[1 - m % 2] : vf_set(0), term[k]);
        LMPI_UNROLL for (int i = 0; i < 8; i++) {
            if (m == 0 && i == 4)
                break;
            LMPI_UNROLL for (int k = 0; k < at_once; k++) {
                sums[3 * i] = sums[3 * i] + light[k].rgb.r * term[k][i];
                sums[3 * i + 1] = sums[3 * i + 1] + light[k].rgb.g * term[k][i];
                sums[3 * i + 2] = sums[3 * i + 2] + light[k].rgb.b * term[k][i];
            }
        }
        sums += GRADIENT_WIDTH;
    }
    return sums;
}

/* Fades lights in, and out again farther away: grad (f L) = f grad L - f' L w. */
LMPI_INLINE void gradient_fade(accumulate_tile tile, int at_once, const lmpi_kernel_lights *lights,
                               size_t first, const vf point[3], lmpi_kernel_fade fade,
                               gradient_band *bands) {
    LMPI_UNROLL for (int k = 0; k < at_once; k++) {
        const size_t i = first + (size_t)k;
        const lmp_vec3_array *center = &lights->center;
        const vf x = lights_at(center->x, center->stride, i) - point[0];
        const vf y = lights_at(center->y, center->stride, i) - point[1];
        const vf z = lights_at(center->z, center->stride, i) - point[2];
        const vf d = vf_sqrt(x * x + y * y + z * z);
        const float size = lights_at(lights->radius.at, lights->radius.stride, i);
        const float radius = size > 0 ? size : 0;
        const fade_lanes in = fade_at(d, radius, fade.per_reach);
        const fade_lanes out = fade_at(d, radius, fade.per_outer);
        const vf value = in.value - out.value, slope = in.slope - out.slope;
        LMPI_ROLLED for (int l = tile.low; l < tile.high; l++) {
            gradient_band *band = &bands[at_once * (l - tile.low) + k];
            band->along = value * band->along - slope * band->value;
            band->across = value * band->across;
            band->value = value * band->value;
        }
    }
}

/* Adds `at_once` lights to the sums of a tile; they fade if fade.per_reach is above 0. */
LMPI_INLINE void gradient_lights(accumulate_tile tile, int at_once,
                                 const lmpi_kernel_lights *lights, size_t first, const vf point[3],
                                 float cos_min, lmpi_kernel_fade fade, gradient_band *bands,
                                 vf *sums) {
    gradient_light light[ACCUMULATE_LIGHTS];
    gradient_prepare(tile, at_once, lights, first, point, cos_min, light, bands);
    if (fade.per_reach > 0)
        gradient_fade(tile, at_once, lights, first, point, fade, bands);
    gradient_column(tile, tile.first, at_once, light, bands);
    for (int m = tile.first; m < tile.end; m++) {
        LMPI_UNROLL for (int k = 0; k < at_once; k++) if (m > tile.first)
            gradient_rotate(m, &light[k]);
        if (m + 1 < tile.high)
            gradient_column(tile, m + 1, at_once, light, bands);
        sums = gradient_column_add(tile, m, at_once, light, bands, sums);
    }
}

static void kernel_fading_gradient(const lmp_scratch *scratch, int bands,
                                   const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                                   float cos_min, lmpi_kernel_fade fade, size_t count,
                                   const lmpi_kernel_out *out, const lmpi_kernel_out *gradient) {
    const accumulate_sets values = { 12, 0, 3, 0 }, slopes = { 12, 3, 9, 0 };
    vf stack[ACCUMULATE_STACK];
    const int each = ACCUMULATE_LIGHTS * (int)(sizeof(gradient_band) / sizeof *stack);
    const accumulate_memory memory = accumulate_lent(scratch, stack);
    const int waiting = accumulate_waits(bands, memory.count, each, GRADIENT_WIDTH);
    const int most = (memory.count - waiting) / GRADIENT_WIDTH;
    gradient_band *band = (gradient_band *)(void *)memory.at;
    vf *sums = memory.at + waiting;
    for (size_t e = 0; e < count; e += LMPI_LANES) {
        const vf point[3] = { vf_load(points->x + e), vf_load(points->y + e),
                              vf_load(points->z + e) };
        const size_t live = layout_live(count, e);
        for (accumulate_tile tile = accumulate_first(bands, most); tile.first < bands;
             tile = accumulate_next(bands, tile, most)) {
            size_t i = 0;
            memset(sums, 0, accumulate_pairs(tile) * GRADIENT_WIDTH * sizeof *sums);
            for (; i + ACCUMULATE_LIGHTS <= lights->count; i += ACCUMULATE_LIGHTS)
                gradient_lights(tile, ACCUMULATE_LIGHTS, lights, i, point, cos_min, fade, band,
                                sums);
            for (; i < lights->count; i++)
                gradient_lights(tile, 1, lights, i, point, cos_min, fade, band, sums);
            accumulate_put(bands, tile, 0, values, sums, memory.at, out, e, live);
            accumulate_put(bands, tile, 0, slopes, sums, memory.at, gradient, e, live);
        }
    }
}

static void kernel_gradient(const lmp_scratch *scratch, int bands, const lmpi_kernel_lights *lights,
                            const lmpi_kernel_vec3 *points, float cos_min, size_t count,
                            const lmpi_kernel_out *out, const lmpi_kernel_out *gradient) {
    const lmpi_kernel_fade none = { 0, 0 };
    kernel_fading_gradient(scratch, bands, lights, points, cos_min, none, count, out, gradient);
}

#endif
