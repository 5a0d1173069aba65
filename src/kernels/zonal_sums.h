/* SPDX-License-Identifier: MIT */
/* zonal_sums.h - sums over bands of what a lobe responds to a cap, by recurrences in the angles of
 * cap and lobe. Lanes are surfaces; lights or blocks of surfaces go side by side. */
#ifndef LAMPION_KERNELS_ZONAL_SUMS_H
#define LAMPION_KERNELS_ZONAL_SUMS_H

#include "src/base/tables.h"
#include "src/base/unroll.h"
#include "src/kernels/lanes.h"

/* Up to so many bands all recurrences run in monic form, x p_(l-1) - c_l p_(l-2): the product of
 * two monic polynomials then stays a normal float. */
#define ZONAL_MONIC_BANDS 48

/* A number that is the same for every surface, as an operand in memory that costs no instruction:
 * AVX-512 broadcasts it as it is read, the others read it broadcast. */
#if LMP_LANES == 16
typedef float zonal_number;
#define zonal_number_of(number) (number)
#define zonal_lanes(number)     vf_set(number)
#else
typedef vf zonal_number;
#define zonal_number_of(number) vf_set(number)
#define zonal_lanes(number)     (number)
#endif

/* Fewer bands are padded by some of weight 0. */
#define ZONAL_BANDS_MIN 3

/* Lights, or blocks of surfaces, that go through the bands of a lobe side by side, at most. */
#define ZONAL_SIDE_BY_SIDE 4

/* What is the same for every surface, by band. The factors of R_l P_l hold their norms, of l = 0
 * those of strength and solid angle, which are pi (1 + |cos a|) and 2 pi times a direction's
 * weight. */
typedef struct zonal_tables {
    float phong[LMP_BANDS_MAX];
    zonal_number cap[ZONAL_MONIC_BANDS], lobe[ZONAL_MONIC_BANDS]; /* c_l; only in monic form */
} zonal_tables;

static inline void zonal_prepare(int bands, int monic, const float *window, zonal_tables *tables) {
    for (int l = 0; l < bands || l < ZONAL_BANDS_MIN; l++) {
        const double factor = l < bands ? lmp_table_zonal_scale[monic][l] * (double)window[l] : 0;
        tables->phong[l] = (float)factor;
        if (monic) {
            tables->cap[l] = zonal_number_of(lmp_table_zonal_cap[l]);
            tables->lobe[l] = zonal_number_of(lmp_table_zonal_lobe[l]);
        }
    }
}

/* lambda_l = lambda_(l-2) (e - l + 2) / (e + l + 1), of the lobe that integrates to 1. */
LMP_INLINE void zonal_phong(int bands, const zonal_tables *tables, vf exponent, vf *weights) {
    vf before = vf_set(1), lambda = (exponent + 1) / (exponent + 2);
    weights[0] = before * tables->phong[0];
    LMP_ROLLED for (int l = 1; l < bands; l++) {
        weights[l] = lambda * tables->phong[l];
        const vf next = before * ((exponent - (float)(l - 1)) / (exponent + (float)(l + 2)));
        before = lambda;
        lambda = next;
    }
}

/* --- a lobe under a light ----------------------------------------------------------------------
 *
 * A sum of a_l P_l goes from the last band to the first (Clenshaw): where P_l = x_l P_(l-1) - c_l
 * P_(l-2), y_l = a_l + x_(l+1) y_(l+1) - c_(l+2) y_(l+2). That spares a product a band, and two
 * registers, of a sum beside P_l. */

/* R_l of caps for l >= 2, R_1 = 1 (t: shade_direction): by itself in monic form; else by its
 * differences, which keeps more bands exact. */
LMP_INLINE void zonal_radial(int lights, int bands, int monic, const zonal_tables *tables,
                             const vf *t, vf *const *r) {
    vf r1[ZONAL_SIDE_BY_SIDE], r0[ZONAL_SIDE_BY_SIDE], x[ZONAL_SIDE_BY_SIDE];
    LMP_UNROLL for (int i = 0; i < lights; i++) {
        x[i] = vf_set(1) - t[i];
        r0[i] = monic ? vf_set(1) : vf_set(0);
        r1[i] = vf_set(1);
        if (monic) {
            r[i][2] = x[i];
            r1[i] = x[i];
        }
    }
    if (monic) {
        LMP_UNROLL for (int l = 3; l < bands; l++) {
            LMP_UNROLL for (int i = 0; i < lights; i++) {
                const vf r2 = x[i] * r1[i] - tables->cap[l] * r0[i];
                r0[i] = r1[i];
                r1[i] = r2;
                r[i][l] = r2;
            }
        }
        return;
    }
    LMP_ROLLED for (int l = 2; l < bands; l++) {
        LMP_UNROLL for (int i = 0; i < lights; i++) {
            r0[i] = lmp_table_cap_d[l] * r0[i] - lmp_table_cap_t[l] * (t[i] * r1[i]);
            r1[i] = r1[i] + r0[i];
            r[i][l] = r1[i];
        }
    }
}

/* x_l and c_l of P_l(v). */
LMP_INLINE vf zonal_x(int monic, int l, vf v) {
    return monic ? v : lmp_table_legendre_t[l] * v;
}

LMP_INLINE vf zonal_c(int monic, const zonal_tables *tables, int l) {
    return monic ? zonal_lanes(tables->lobe[l]) : vf_set(lmp_table_legendre_d[l]);
}

/* The sum of a Phong lobe from l = 1 on, of lights side by side: each waits for itself. */
LMP_INLINE void zonal_phong_sum(int lights, int bands, int monic, const zonal_tables *tables,
                                const vf *const *weights, const vf *const *r, const vf *v,
                                vf *sums) {
    vf y2[ZONAL_SIDE_BY_SIDE], y1[ZONAL_SIDE_BY_SIDE];
    LMP_UNROLL for (int i = 0; i < lights; i++) {
        y2[i] = vf_set(0);
        y1[i] = weights[i][bands - 1] * r[i][bands - 1];
    }
    LMP_UNROLL for (int l = bands - 2; l >= 1; l--) {
        LMP_UNROLL for (int i = 0; i < lights; i++) {
            vf own = l > 1 ? weights[i][l] * r[i][l] : weights[i][1];
            if (l < bands - 2)
                own = own - zonal_c(monic, tables, l + 2) * y2[i];
            y2[i] = y1[i];
            y1[i] = own + zonal_x(monic, l + 1, v[i]) * y1[i];
        }
    }
    LMP_UNROLL for (int i = 0; i < lights; i++) sums[i] =
        v[i] * y1[i] - zonal_c(monic, tables, 2) * y2[i];
}

#endif
