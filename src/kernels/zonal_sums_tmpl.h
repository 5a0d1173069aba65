/* SPDX-License-Identifier: MIT */
/* zonal_sums_tmpl.h - a lobe's responses to caps as sums over bands, by recurrences in the angles
 * of cap and lobe. Lanes are surfaces; lights or blocks of surfaces go side by side. */
#ifndef LAMPION_KERNELS_ZONAL_SUMS_TMPL_H
#define LAMPION_KERNELS_ZONAL_SUMS_TMPL_H

#include "src/base/tables.h"
#include "src/base/unroll.h"
#include "src/kernels/lanes.h"

/* The number of bands up to which all recurrences run in monic form, x p_(l-1) - c_l p_(l-2): the
 * product of two monic polynomials then stays a normal float. */
#define ZONAL_MONIC_BANDS 48

/* The fewest bands; fewer are padded by bands of weight 0. */
#define ZONAL_BANDS_MIN 3

/* The most lights, or blocks of surfaces, that go through the bands of a lobe side by side. */
#define ZONAL_SIDE_BY_SIDE 4

/* Numbers per band that all surfaces share. The factors of R_l P_l include their norms; those of l
 * = 0 are the factors of strength and solid angle, which are pi (1 + |cos a|) and 2 pi times a
 * direction's weight. */
typedef struct zonal_tables {
    float phong[LMP_BANDS_MAX];
    vf_number cap[ZONAL_MONIC_BANDS], lobe[ZONAL_MONIC_BANDS]; /* c_l; set only in monic form */
} zonal_tables;

static inline void zonal_prepare(int bands, int monic, const float *window, zonal_tables *tables) {
    for (int l = 0; l < bands || l < ZONAL_BANDS_MIN; l++) {
        const double factor = l < bands ? lmpi_table_zonal_scale[monic][l] * (double)window[l] : 0;
        tables->phong[l] = (float)factor;
        if (monic) {
            tables->cap[l] = vf_number_of(lmpi_table_zonal_cap[l]);
            tables->lobe[l] = vf_number_of(lmpi_table_zonal_lobe[l]);
        }
    }
}

/* Computes lambda_l = lambda_(l-2) (e - l + 2) / (e + l + 1), of the lobe of integral 1, times
 * factors[l]. */
LMPI_INLINE void zonal_phong(int bands, const float *factors, vf exponent, vf *weights) {
    vf before = vf_set(1), lambda = (exponent + 1) / (exponent + 2);
    weights[0] = before * factors[0];
    LMPI_ROLLED for (int l = 1; l < bands; l++) {
        weights[l] = lambda * factors[l];
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

/* Computes R_l of caps for l >= 2, with R_1 = 1 (t: shade_direction): directly in monic form,
 * otherwise by differences, which keep more bands exact. */
LMPI_INLINE void zonal_radial(int lights, int bands, int monic, const zonal_tables *tables,
                              const vf *t, vf *const *r) {
    vf r1[ZONAL_SIDE_BY_SIDE], r0[ZONAL_SIDE_BY_SIDE], x[ZONAL_SIDE_BY_SIDE];
    LMPI_UNROLL for (int i = 0; i < lights; i++) {
        x[i] = vf_set(1) - t[i];
        r0[i] = monic ? vf_set(1) : vf_set(0);
        r1[i] = vf_set(1);
        if (monic) {
            r[i][2] = x[i];
            r1[i] = x[i];
        }
    }
    if (monic) {
        LMPI_UNROLL for (int l = 3; l < bands; l++) {
            LMPI_UNROLL for (int i = 0; i < lights; i++) {
                const vf r2 = x[i] * r1[i] - tables->cap[l] * r0[i];
                r0[i] = r1[i];
                r1[i] = r2;
                r[i][l] = r2;
            }
        }
        return;
    }
    LMPI_ROLLED for (int l = 2; l < bands; l++) {
        LMPI_UNROLL for (int i = 0; i < lights; i++) {
            r0[i] = lmpi_table_cap_d[l] * r0[i] - lmpi_table_cap_t[l] * (t[i] * r1[i]);
            r1[i] = r1[i] + r0[i];
            r[i][l] = r1[i];
        }
    }
}

/* Return the factors x_l and c_l of the recurrence of P_l(v). */
LMPI_INLINE vf zonal_x(int monic, int l, vf v) {
    return monic ? v : lmpi_table_legendre_t[l] * v;
}

LMPI_INLINE vf zonal_c(int monic, const zonal_tables *tables, int l) {
    return monic ? vf_number_lanes(tables->lobe[l]) : vf_set(lmpi_table_legendre_d[l]);
}

/* Sums a Phong lobe from l = 1 on, for several lights side by side, because each waits for itself.
 */
LMPI_INLINE void zonal_phong_sum(int lights, int bands, int monic, const zonal_tables *tables,
                                 const vf *const *weights, const vf *const *r, const vf *v,
                                 vf *sums) {
    vf y2[ZONAL_SIDE_BY_SIDE], y1[ZONAL_SIDE_BY_SIDE];
    LMPI_UNROLL for (int i = 0; i < lights; i++) {
        y2[i] = vf_set(0);
        y1[i] = weights[i][bands - 1] * r[i][bands - 1];
    }
    LMPI_UNROLL for (int l = bands - 2; l >= 1; l--) {
        LMPI_UNROLL for (int i = 0; i < lights; i++) {
            vf own = l > 1 ? weights[i][l] * r[i][l] : weights[i][1];
            if (l < bands - 2)
                own = own - zonal_c(monic, tables, l + 2) * y2[i];
            y2[i] = y1[i];
            y1[i] = own + zonal_x(monic, l + 1, v[i]) * y1[i];
        }
    }
    LMPI_UNROLL for (int i = 0; i < lights; i++) sums[i] =
        v[i] * y1[i] - zonal_c(monic, tables, 2) * y2[i];
}

#endif
