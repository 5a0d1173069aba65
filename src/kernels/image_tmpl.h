/* SPDX-License-Identifier: MIT */
/* image_tmpl.h - projects texels of an image: lanes are texels, all of which add to the same sums.
 * On every instruction set a sum is made of sixteen partial sums, of the texels i, i + 16, …;
 * narrow registers take these in turns. */
#ifndef LAMPION_KERNELS_IMAGE_TMPL_H
#define LAMPION_KERNELS_IMAGE_TMPL_H

#include "src/kernels/basis_tmpl.h"
#include "src/kernels/sh.h"

#define IMAGE_SUMS 16 /* a whole number of lanes */

/* The state of the columns of all texels: q_l in one half of q and q_(l-1) in the other, and C_m,
 * S_m. */
typedef struct image_column {
    float LMPI_ALIGNED q[2][LMPI_KERNEL_TEXELS], c[LMPI_KERNEL_TEXELS], s[LMPI_KERNEL_TEXELS];
} image_column;

/* Returns the sum of sixteen partial sums, added by halves. */
LMPI_INLINE double image_sum(const float *part) {
    float folded[IMAGE_SUMS / 2];
    LMPI_UNROLL for (int i = 0; i < 8; i++) folded[i] = part[i] + part[i + 8];
    LMPI_UNROLL for (int i = 0; i < 4; i++) folded[i] = folded[i] + folded[i + 4];
    return (double)((folded[0] + folded[2]) + (folded[1] + folded[3]));
}

/* Adds q_l {C_m, S_m} times the values of `channels` channels to their sums of band l. */
LMPI_INLINE void image_add(int channels, int sines, int l, const float *q,
                           const image_column *column, const lmpi_kernel_texels *texels,
                           size_t count, double (*cosine)[LMP_BANDS_MAX],
                           double (*sine)[LMP_BANDS_MAX]) {
    float LMPI_ALIGNED parts[2][LMPI_KERNEL_CHANNELS][IMAGE_SUMS];
    for (size_t first = 0; first < IMAGE_SUMS; first += LMPI_LANES) {
        vf sum[2][LMPI_KERNEL_CHANNELS];
        LMPI_UNROLL for (int i = 0; i < channels; i++) sum[0][i] = sum[1][i] = vf_set(0);
        for (size_t e = first; e < count; e += IMAGE_SUMS) {
            const vf value = vf_load(q + e), plus = value * vf_load(column->c + e);
            const vf minus = sines ? value * vf_load(column->s + e) : plus;
            LMPI_UNROLL for (int i = 0; i < channels; i++) {
                const vf light = vf_load(texels->value[i] + e);
                sum[0][i] = sum[0][i] + plus * light;
                if (sines)
                    sum[1][i] = sum[1][i] + minus * light;
            }
        }
        LMPI_UNROLL for (int i = 0; i < channels; i++) {
            vf_store(parts[0][i] + first, sum[0][i]);
            vf_store(parts[1][i] + first, sum[1][i]);
        }
    }
    LMPI_UNROLL for (int i = 0; i < channels; i++) {
        cosine[i][l] += image_sum(parts[0][i]);
        if (sines)
            sine[i][l] += image_sum(parts[1][i]);
    }
}

/* Adds texels to every band of order m; count is a multiple of IMAGE_SUMS. */
LMPI_INLINE void image_order(int channels, int sines, int bands, int m,
                             const lmpi_kernel_texels *texels, size_t count, image_column *column,
                             double (*cosine)[LMP_BANDS_MAX], double (*sine)[LMP_BANDS_MAX]) {
    float *now = column->q[0], *before = column->q[1];
    for (size_t e = 0; e < count; e += LMPI_LANES)
        vf_store(now + e, vf_set(lmpi_table_diagonal[m]));
    for (int l = m; l < bands; l++) {
        image_add(channels, sines, l, now, column, texels, count, cosine, sine);
        if (l + 1 == bands)
            return;
        for (size_t e = 0; e < count; e += LMPI_LANES)
            vf_store(before + e, basis_step(lmpi_table_a, lmpi_table_b, l + 1, m,
                                            vf_load(texels->direction.z + e), vf_load(now + e),
                                            l > m ? vf_load(before + e) : vf_set(0)));
        float *next = before;
        before = now;
        now = next;
    }
}

LMPI_INLINE void image_orders(int channels, int bands, int m, int orders,
                              const lmpi_kernel_texels *texels, size_t count,
                              lmpi_kernel_texel_sums *sums) {
    image_column column;
    for (size_t e = 0; e < count; e += LMPI_LANES) {
        vf c = vf_set(1), s = vf_set(0);
        for (int k = 1; k <= m; k++)
            basis_rotate(k, vf_load(texels->direction.x + e), vf_load(texels->direction.y + e), &c,
                         &s);
        vf_store(column.c + e, c);
        vf_store(column.s + e, s);
    }
    for (int i = 0; i < orders; i++) {
        if (m + i == 0)
            image_order(channels, 0, bands, 0, texels, count, &column, sums->cosine[i],
                        sums->sine[i]);
        else
            image_order(channels, 1, bands, m + i, texels, count, &column, sums->cosine[i],
                        sums->sine[i]);
        for (size_t e = 0; i + 1 < orders && e < count; e += LMPI_LANES) {
            vf c = vf_load(column.c + e), s = vf_load(column.s + e);
            basis_rotate(m + i + 1, vf_load(texels->direction.x + e),
                         vf_load(texels->direction.y + e), &c, &s);
            vf_store(column.c + e, c);
            vf_store(column.s + e, s);
        }
    }
}

static void kernel_image(int bands, int m, int orders, const lmpi_kernel_texels *texels,
                         size_t count, lmpi_kernel_texel_sums *sums) {
    const size_t whole = (count + IMAGE_SUMS - 1) / IMAGE_SUMS * IMAGE_SUMS;
    switch (texels->channels) {
    case 1:
        image_orders(1, bands, m, orders, texels, whole, sums);
        break;
    case 2:
        image_orders(2, bands, m, orders, texels, whole, sums);
        break;
    case 3:
        image_orders(3, bands, m, orders, texels, whole, sums);
        break;
    default:
        image_orders(4, bands, m, orders, texels, whole, sums);
    }
}

#endif
