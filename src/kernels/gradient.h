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

typedef struct gradient_light {
    vf x, y, z;
    vf value[LMP_BANDS_MAX];  /* pi s2 R_l */
    vf across[LMP_BANDS_MAX]; /* (pi s2/d) R_l */
    vf along[LMP_BANDS_MAX];  /* (pi s2/d) 2 P_l/alpha */
    vf c[LMP_BANDS_MAX], s[LMP_BANDS_MAX];
    lmp_rgb rgb;
} gradient_light;

static inline void gradient_prepare(int bands, const lmp_kernel_lights *lights, size_t i,
                                    const vf point[3], float cos_min, gradient_light *light) {
    cap_lanes cap = lights_cap(lights, i, point, 1);
    cap_axis(&cap);
    light->x = cap.x;
    light->y = cap.y;
    light->z = cap.z;
    light->rgb = lights_radiance(lights, i);
    cap_radial(bands, &cap, vf_set(LMP_KERNEL_PI), light->value);
    const vf per_distance = LMP_KERNEL_PI * cap.s2_per_d;
    const vf outward = (per_distance + per_distance) / vf_max(cap.alpha, vf_set(cos_min));
    vf r = per_distance, r_difference = vf_set(0), p = vf_set(1), p_difference = vf_set(0);
    light->across[0] = vf_set(0);
    light->along[0] = outward;
    light->c[0] = vf_set(1);
    light->s[0] = vf_set(0);
    for (int l = 1; l < bands; l++) {
        if (l > 1) {
            r_difference = lmp_table_cap_d[l] * r_difference - lmp_table_cap_t[l] * cap.t * r;
            r = r + r_difference;
        }
        p_difference = lmp_table_legendre_d[l] * p_difference - lmp_table_legendre_t[l] * cap.t * p;
        p = p + p_difference;
        /* Parity: R_l changes sign inside with even l, P_l with odd. */
        light->across[l] = l % 2 ? r : r * cap.even;
        light->along[l] = outward * (l % 2 ? p * cap.even : p);
        light->c[l] = light->c[l - 1];
        light->s[l] = light->s[l - 1];
        basis_turn(l, cap.x, cap.y, &light->c[l], &light->s[l]);
    }
}

/* Column m of q into q[l], m <= l < bands. */
static inline void gradient_column(int bands, int m, vf z, vf *q) {
    const size_t base = lmp_table_index(m, m);
    q[m] = vf_set(lmp_table_diagonal[m]);
    for (int l = m + 1; l < bands; l++) {
        const size_t i = base + (size_t)(l - m);
        q[l] = l == m + 1 ? lmp_table_a[i] * z * q[l - 1]
                          : lmp_table_a[i] * z * q[l - 1] + lmp_table_b[i] * q[l - 2];
    }
}

/* (l, m) for one light: of +m the value, d/dx, d/dy, d/dz, then of -m. */
LMP_INLINE void gradient_entry(const gradient_light *light, int l, int m, vf q, vf slope,
                               vf term[8]) {
    const vf c = light->c[m], s = light->s[m], x = light->x, y = light->y, z = light->z;
    const vf mc = m ? (float)m * light->c[m - 1] : vf_set(0);
    const vf ms = m ? (float)m * light->s[m - 1] : vf_set(0);
    const vf across = light->across[l] * q, tilt = light->across[l] * slope;
    const vf along = light->along[l] * q + (float)m * across + z * tilt;
    const vf value = light->value[l] * q, up = z * along - tilt;
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
    vf columns[2][ACCUMULATE_LIGHTS][LMP_BANDS_MAX];
    vf(*q)[LMP_BANDS_MAX] = columns[0], (*above)[LMP_BANDS_MAX] = columns[1];
    for (int k = 0; end < bands && k < at_once; k++)
        gradient_column(bands, end, light[k].z, above[k]);
    for (int m = first; m < end; m++)
        sums += (bands - m) * GRADIENT_WIDTH;
    for (int m = end - 1; m >= first; m--) {
        for (int k = 0; k < at_once; k++)
            gradient_column(bands, m, light[k].z, q[k]);
        sums -= (bands - m) * GRADIENT_WIDTH;
        const float *slopes = lmp_table_slope + lmp_table_index(m, m);
        for (int l = m; l < bands; l++) {
            vf *sum = sums + (l - m) * GRADIENT_WIDTH, term[ACCUMULATE_LIGHTS][8];
            LMP_UNROLL for (int k = 0; k < at_once; k++) gradient_entry(
                &light[k], l, m, q[k][l], l > m ? slopes[l - m] * above[k][l] : vf_set(0), term[k]);
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
        vf(*const swap)[LMP_BANDS_MAX] = q;
        q = above;
        above = swap;
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
            accumulate_put(bands, first, end, 0, 12, 0, 3, sums, out, e, live);
            accumulate_put(bands, first, end, 0, 12, 3, 9, sums, gradient, e, live);
        }
    }
}

#endif
