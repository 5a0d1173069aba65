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

/* What a band needs lies together: arrays of LMP_BANDS_MAX registers begin in one set of the first
 * cache, and there are more of them here than ways. */
typedef struct gradient_band {
    vf value;  /* pi s2 R_l */
    vf across; /* (pi s2/d) R_l */
    vf along;  /* (pi s2/d) 2 P_l/alpha */
    vf c, s;   /* C_m, S_m of m = l */
} gradient_band;

typedef struct gradient_light {
    vf x, y, z;
    lmp_rgb rgb;
    gradient_band band[LMP_BANDS_MAX];
} gradient_light;

/* q of one (l, m), and of (l, m + 1). */
typedef struct gradient_pair {
    vf q[2][ACCUMULATE_LIGHTS];
} gradient_pair;

static inline void gradient_prepare(int bands, const lmp_kernel_lights *lights, size_t i,
                                    const vf point[3], float cos_min, gradient_light *light) {
    cap_lanes cap = lights_cap(lights, i, point, 1);
    cap_axis(&cap);
    light->x = cap.x;
    light->y = cap.y;
    light->z = cap.z;
    light->rgb = lights_radiance(lights, i);
    vf radial[LMP_BANDS_MAX];
    cap_radial(bands, &cap, vf_set(LMP_KERNEL_PI), radial);
    const vf per_distance = LMP_KERNEL_PI * cap.s2_per_d;
    const vf outward = (per_distance + per_distance) / vf_max(cap.alpha, vf_set(cos_min));
    vf r = per_distance, r_difference = vf_set(0), p = vf_set(1), p_difference = vf_set(0);
    vf c = vf_set(1), s = vf_set(0);
    light->band[0] = (gradient_band) { radial[0], vf_set(0), outward, c, s };
    for (int l = 1; l < bands; l++) {
        if (l > 1) {
            r_difference = lmp_table_cap_d[l] * r_difference - lmp_table_cap_t[l] * cap.t * r;
            r = r + r_difference;
        }
        p_difference = lmp_table_legendre_d[l] * p_difference - lmp_table_legendre_t[l] * cap.t * p;
        p = p + p_difference;
        /* Parity: R_l changes sign inside with even l, P_l with odd. */
        basis_turn(l, cap.x, cap.y, &c, &s);
        light->band[l] = (gradient_band) { radial[l], l % 2 ? r : r * cap.even,
                                           outward * (l % 2 ? p * cap.even : p), c, s };
    }
}

/* Column m of light k, m <= l < bands. */
static inline void gradient_column(int bands, int m, vf z, gradient_pair *pairs, int k) {
    vf q0 = vf_set(0), q1 = vf_set(lmp_table_diagonal[m]);
    pairs[m].q[m % 2][k] = q1;
    for (int l = m + 1; l < bands; l++) {
        const vf q2 = basis_step(lmp_table_a, lmp_table_b, l, m, z, q1, q0);
        q0 = q1;
        q1 = q2;
        pairs[l].q[m % 2][k] = q1;
    }
}

/* (l, m) for one light: of +m the value, d/dx, d/dy, d/dz, then of -m. */
LMP_INLINE void gradient_entry(const gradient_light *light, int l, int m, vf q, vf slope,
                               vf term[8]) {
    const gradient_band *band = &light->band[l];
    const vf c = light->band[m].c, s = light->band[m].s;
    const vf x = light->x, y = light->y, z = light->z;
    const vf mc = m ? (float)m * light->band[m - 1].c : vf_set(0);
    const vf ms = m ? (float)m * light->band[m - 1].s : vf_set(0);
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

/* Columns first … end-1; the sums of a column follow those of the column below it. */
LMP_INLINE void gradient_columns(int bands, int first, int end, int at_once,
                                 const gradient_light *light, vf *sums) {
    gradient_pair pairs[LMP_BANDS_MAX];
    for (int k = 0; end < bands && k < at_once; k++)
        gradient_column(bands, end, light[k].z, pairs, k);
    for (int m = first; m < end; m++)
        sums += (bands - m) * GRADIENT_WIDTH;
    for (int m = end - 1; m >= first; m--) {
        for (int k = 0; k < at_once; k++)
            gradient_column(bands, m, light[k].z, pairs, k);
        sums -= (bands - m) * GRADIENT_WIDTH;
        const float *slopes = lmp_table_slope + lmp_table_index(m, m);
        for (int l = m; l < bands; l++) {
            vf *sum = sums + (l - m) * GRADIENT_WIDTH, term[ACCUMULATE_LIGHTS][8];
            LMP_UNROLL for (int k = 0; k < at_once; k++) gradient_entry(
                &light[k], l, m, pairs[l].q[m % 2][k],
                l > m ? slopes[l - m] * pairs[l].q[1 - m % 2][k] : vf_set(0), term[k]);
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

static void kernel_gradient(int bands, const lmp_kernel_lights *lights,
                            const lmp_kernel_vec3 *points, float cos_min, size_t count,
                            const lmp_kernel_out *out, const lmp_kernel_out *gradient) {
    vf sums[LMP_TILE];
    gradient_light light[ACCUMULATE_LIGHTS];
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const vf point[3] = { vf_load(points->x + e), vf_load(points->y + e),
                              vf_load(points->z + e) };
        const size_t live = layout_live(count, e);
        for (int first = 0, end; first < bands; first = end) {
            end = accumulate_tile(bands, first, GRADIENT_WIDTH, sums);
            size_t i = 0;
            for (; i + ACCUMULATE_LIGHTS <= lights->count; i += ACCUMULATE_LIGHTS) {
                for (size_t k = 0; k < ACCUMULATE_LIGHTS; k++)
                    gradient_prepare(bands, lights, i + k, point, cos_min, &light[k]);
                gradient_columns(bands, first, end, ACCUMULATE_LIGHTS, light, sums);
            }
            for (; i < lights->count; i++) {
                gradient_prepare(bands, lights, i, point, cos_min, &light[0]);
                gradient_columns(bands, first, end, 1, light, sums);
            }
            accumulate_put(bands, first, end, 0, (accumulate_sets) { 12, 0, 3 }, sums, out, e,
                           live);
            accumulate_put(bands, first, end, 0, (accumulate_sets) { 12, 3, 9 }, sums, gradient, e,
                           live);
        }
    }
}

#endif
