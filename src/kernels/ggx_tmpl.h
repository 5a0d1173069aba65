/* SPDX-License-Identifier: MIT */
/* ggx_tmpl.h - interpolates the lobes of GGX for many surfaces from their table: lanes are
 * surfaces. */
#ifndef LAMPION_KERNELS_GGX_TMPL_H
#define LAMPION_KERNELS_GGX_TMPL_H

#include "src/kernels/layout_tmpl.h"
#include "src/kernels/lobe.h"

/* Floats of a node: four parameters of each lobe (lmpi_ggx_table). */
#define GGX_NODE (4 * LMPI_KERNEL_LOBES_MAX)

/* Where a block of surfaces lies in the table: the node before each surface, and the fractions of
 * the nodes after it, to the right and below. */
typedef struct ggx_place {
    vf along, cosine, alpha, right, below;
    int32_t column[LMPI_LANES];
    const float *node[LMPI_LANES];
} ggx_place;

/* Clamps x to least … most; NaN becomes `least`. */
LMPI_INLINE vf ggx_clamped(vf x, float least, float most) {
    const vf raised = vf_select_less(vf_set(least), x, x, vf_set(least));
    return vf_select_less(raised, vf_set(most), raised, vf_set(most));
}

LMPI_INLINE vf ggx_mix(vf a, vf b, vf fraction) {
    return a + (b - a) * fraction;
}

LMPI_INLINE void ggx_locate(const lmpi_kernel_ggx *table, const vf n[3], const vf v[3],
                            vf roughness, ggx_place *place) {
    const float least = table->roughness_min, rows = (float)(table->roughnesses - 1);
    const vf rough = ggx_clamped(roughness, least, 1);
    place->along = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
    place->cosine = ggx_clamped(place->along, 0, 1);
    place->alpha = rough * rough;
    const vf y = (rough - least) / vf_set(1 - least) * rows;
    const vf x = vf_sqrt(place->cosine) * (float)(table->views - 1);
    const vi row = vi_from(ggx_clamped(y, 0, (float)(table->roughnesses - 2)));
    const vi column = vi_from(ggx_clamped(x, 0, (float)(table->views - 2)));
    const vi node = row * table->views + column;
    int32_t at[LMPI_LANES];
    memcpy(at, &node, sizeof at);
    memcpy(place->column, &column, sizeof place->column);
    LMPI_UNROLL for (int i = 0; i < LMPI_LANES; i++) place->node[i] =
        table->nodes + (ptrdiff_t)at[i] * GGX_NODE;
    place->below = y - vf_from(row);
    place->right = x - vf_from(column);
}

/* Interpolates the parameters of a lobe. */
#if LMPI_LANES > 1
LMPI_INLINE void ggx_interpolate(int lobe, ptrdiff_t row, const ggx_place *place, vf p[4]) {
    /* Interpolates for surfaces i, i + 4, i + 8 …, each in a quarter of a register. */
#define GGX_QUARTERS(i)                                                                            \
    do {                                                                                           \
        const float *at[4][LMPI_LANES / 4];                                                        \
        LMPI_UNROLL for (int g = 0; g < LMPI_LANES / 4; g++) {                                     \
            const float *node = place->node[4 * g + (i)] + (ptrdiff_t)4 * lobe;                    \
            at[0][g] = node;                                                                       \
            at[1][g] = node + GGX_NODE;                                                            \
            at[2][g] = node + row;                                                                 \
            at[3][g] = node + row + GGX_NODE;                                                      \
        }                                                                                          \
        const vf right = LMPI_SHUFFLE(place->right, place->right, i, i, i, i);                     \
        const vf below = LMPI_SHUFFLE(place->below, place->below, i, i, i, i);                     \
        p[i] = ggx_mix(ggx_mix(layout_quarters(at[0]), layout_quarters(at[1]), right),             \
                       ggx_mix(layout_quarters(at[2]), layout_quarters(at[3]), right), below);     \
    } while (0)
    GGX_QUARTERS(0);
    GGX_QUARTERS(1);
    GGX_QUARTERS(2);
    GGX_QUARTERS(3);
#undef GGX_QUARTERS
    layout_transpose4(p);
}
#else
LMPI_INLINE void ggx_interpolate(int lobe, ptrdiff_t row, const ggx_place *place, vf p[4]) {
    const float *near = place->node[0] + (ptrdiff_t)4 * lobe, *far = near + row;
    for (int j = 0; j < 4; j++)
        p[j] = ggx_mix(ggx_mix(near[j], near[j + GGX_NODE], place->right),
                       ggx_mix(far[j], far[j + GGX_NODE], place->right), place->below);
}
#endif

LMPI_INLINE void ggx_lobe(const ggx_place *place, const vf n[3], const vf v[3], const vf p[4],
                          size_t e, const lmpi_kernel_ggx_lobe *to) {
    const vf one = vf_set(1), rise = place->cosine + place->alpha * p[0] + place->along;
    const vf x = n[0] * rise - v[0], y = n[1] * rise - v[1], z = n[2] * rise - v[2];
    const vf scale = one / vf_sqrt(x * x + y * y + z * z);
    vf_store(to->axis[0] + e, x * scale);
    vf_store(to->axis[1] + e, y * scale);
    vf_store(to->axis[2] + e, z * scale);
    vf_store(to->exponent + e, one / (place->alpha * place->alpha * p[1]));
    vf_store(to->f0 + e, p[2] - p[3]);
    vf_store(to->f90 + e, p[3]);
}

static void kernel_ggx(const lmpi_kernel_ggx *table, const lmpi_kernel_vec3 *normal,
                       const lmpi_kernel_vec3 *view, const float *roughness, size_t count,
                       int lobes, const lmpi_kernel_ggx_lobe *to, float *diffuse_f90) {
    const ptrdiff_t row = (ptrdiff_t)table->views * GGX_NODE;
    for (size_t e = 0; e < count; e += LMPI_LANES) {
        const vf n[3] = { vf_load(normal->x + e), vf_load(normal->y + e), vf_load(normal->z + e) };
        const vf v[3] = { vf_load(view->x + e), vf_load(view->y + e), vf_load(view->z + e) };
        float near[LMPI_LANES], far[LMPI_LANES];
        ggx_place place;
        ggx_locate(table, n, v, vf_load(roughness + e), &place);
        for (int k = 0; k < lobes; k++) {
            vf p[4];
            ggx_interpolate(k, row, &place, p);
            ggx_lobe(&place, n, v, p, e, &to[k]);
        }
        for (int i = 0; i < LMPI_LANES; i++) {
            near[i] = table->diffuse[place.column[i]];
            far[i] = table->diffuse[place.column[i] + 1];
        }
        vf_store(diffuse_f90 + e, ggx_mix(vf_load(near), vf_load(far), place.right));
    }
}

#endif
