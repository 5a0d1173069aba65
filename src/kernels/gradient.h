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

LMP_INLINE void gradient_add(vf *sums, lmp_rgb rgb, vf value) {
    sums[0] = sums[0] + rgb.r * value;
    sums[1] = sums[1] + rgb.g * value;
    sums[2] = sums[2] + rgb.b * value;
}

/* Columns first … end-1; the sums of a column follow those of the column below it. */
static inline void gradient_columns(int bands, int first, int end, const gradient_light *light,
                                    vf *sums) {
    vf columns[2][LMP_BANDS_MAX], *q = columns[0], *above = columns[1];
    const vf x = light->x, y = light->y, z = light->z;
    if (end < bands)
        gradient_column(bands, end, z, above);
    for (int m = first; m < end; m++)
        sums += (bands - m) * GRADIENT_WIDTH;
    for (int m = end - 1; m >= first; m--) {
        gradient_column(bands, m, z, q);
        sums -= (bands - m) * GRADIENT_WIDTH;
        const size_t base = lmp_table_index(m, m);
        const vf c = light->c[m], s = light->s[m];
        const vf xc = x * c, yc = y * c, xs = x * s, ys = y * s;
        const vf mc = m ? (float)m * light->c[m - 1] : vf_set(0);
        const vf ms = m ? (float)m * light->s[m - 1] : vf_set(0);
        for (int l = m; l < bands; l++) {
            vf *sum = sums + (l - m) * GRADIENT_WIDTH;
            const vf slope = l > m ? lmp_table_slope[base + (size_t)(l - m)] * above[l] : vf_set(0);
            const vf across = light->across[l] * q[l], tilt = light->across[l] * slope;
            const vf along = light->along[l] * q[l] + (float)m * across + z * tilt;
            const vf value = light->value[l] * q[l], up = z * along - tilt;
            gradient_add(sum, light->rgb, value * c);
            gradient_add(sum + 3, light->rgb, xc * along - mc * across);
            gradient_add(sum + 6, light->rgb, yc * along + ms * across);
            gradient_add(sum + 9, light->rgb, c * up);
            if (m == 0)
                continue;
            gradient_add(sum + 12, light->rgb, value * s);
            gradient_add(sum + 15, light->rgb, xs * along - ms * across);
            gradient_add(sum + 18, light->rgb, ys * along - mc * across);
            gradient_add(sum + 21, light->rgb, s * up);
        }
        vf *swap = q;
        q = above;
        above = swap;
    }
}

static void kernel_gradient(int bands, const lmp_kernel_lights *lights,
                            const lmp_kernel_vec3 *points, float cos_min, size_t count,
                            const lmp_kernel_out *out, const lmp_kernel_out *gradient) {
    vf sums[LMP_TILE];
    gradient_light light;
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const vf point[3] = { vf_load(points->x + e), vf_load(points->y + e),
                              vf_load(points->z + e) };
        const size_t live = layout_live(count, e);
        for (int first = 0, end; first < bands; first = end) {
            end = accumulate_tile(bands, first, GRADIENT_WIDTH, sums);
            for (size_t i = 0; i < lights->count; i++) {
                gradient_prepare(bands, lights, i, point, cos_min, &light);
                gradient_columns(bands, first, end, &light, sums);
            }
            accumulate_put(bands, first, end, 0, 12, 0, 3, sums, out, e, live);
            accumulate_put(bands, first, end, 0, 12, 3, 9, sums, gradient, e, live);
        }
    }
}

#endif
