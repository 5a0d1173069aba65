/* SPDX-License-Identifier: MIT */
/* project_tmpl.h - the kernels that write what they compute: basis, zonal coefficients, sphere
 * lights. */
#ifndef LAMPION_KERNELS_PROJECT_TMPL_H
#define LAMPION_KERNELS_PROJECT_TMPL_H

#include "src/kernels/basis_tmpl.h"
#include "src/kernels/cap_tmpl.h"
#include "src/kernels/light.h"

/* Writes BASIS_BLOCKS full blocks of any number of bands side by side, where planes take them. */
LMPI_INLINE int put_wide(const lmpi_kernel_out *out, size_t element, size_t count) {
    return out->planar && element + BASIS_BLOCKS * LMPI_LANES <= count;
}

LMPI_INLINE void eval_axis(const lmpi_kernel_vec3 *directions, size_t e, vf axis[3]) {
    axis[0] = vf_load(directions->x + e);
    axis[1] = vf_load(directions->y + e);
    axis[2] = vf_load(directions->z + e);
}

LMPI_INLINE lmpi_kernel_vec3 project_from(const lmpi_kernel_vec3 *vectors, size_t e) {
    return (lmpi_kernel_vec3) { vectors->x + e, vectors->y + e, vectors->z + e };
}

static LMPI_NOINLINE void eval_any(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                                   const lmpi_kernel_out *out) {
    size_t e = 0;
    vf axis[BASIS_BLOCKS][3];
    for (; put_wide(out, e, count); e += BASIS_BLOCKS * LMPI_LANES) {
        for (size_t k = 0; k < BASIS_BLOCKS; k++)
            eval_axis(directions, e + k * LMPI_LANES, axis[k]);
        basis_columns_wide(bands, axis, NULL, out->at + e, out->stride);
    }
    for (; e < count; e += LMPI_LANES) {
        eval_axis(directions, e, axis[0]);
        basis_put(bands, axis[0], NULL, out, e, count);
    }
}

LMPI_INLINE void eval_bands(int bands, int constant, const lmpi_kernel_vec3 *directions,
                            size_t count, const lmpi_kernel_out *out) {
    size_t e = 0;
    vf axis[3];
    for (; constant && out->planar && e + LMPI_LANES <= count; e += LMPI_LANES) {
        eval_axis(directions, e, axis);
        basis_straight(bands, axis, NULL, out->at + e, out->stride);
    }
    for (; constant && e < count; e += LMPI_LANES) {
        eval_axis(directions, e, axis);
        basis_put_straight(bands, axis, NULL, out, e, count);
    }
}

static LMPI_NOINLINE void eval_straight(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                                        const lmpi_kernel_out *out) {
    BASIS_SPECIALISE(bands, eval_bands, directions, count, out)
}

static void kernel_eval(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                        const lmpi_kernel_out *out) {
    if (bands <= BASIS_STRAIGHT)
        eval_straight(bands, directions, count, out);
    else
        eval_any(bands, directions, count, out);
}

/* Finds the axis of the cap of pair e, and the factors of its bands. */
LMPI_INLINE
void project_cap(int bands, const lmpi_kernel_pairs *pairs, size_t e, vf axis[3], vf *radial) {
    cap_lanes cap = cap_from(vf_load(pairs->center.x + e) - vf_load(pairs->point.x + e),
                             vf_load(pairs->center.y + e) - vf_load(pairs->point.y + e),
                             vf_load(pairs->center.z + e) - vf_load(pairs->point.z + e),
                             vf_load(pairs->radius + e), 0);
    cap_axis(&cap);
    axis[0] = cap.x;
    axis[1] = cap.y;
    axis[2] = cap.z;
    cap_radial(bands, &cap, vf_set(LMPI_KERNEL_PI), radial);
}

static LMPI_NOINLINE void project_wide(int bands, const lmpi_kernel_pairs *pairs, size_t e,
                                       const lmpi_kernel_out *out) {
    vf axis[BASIS_BLOCKS][3], radial[BASIS_BLOCKS][LMP_BANDS_MAX];
    LMPI_ROLLED for (size_t k = 0; k < BASIS_BLOCKS; k++)
        project_cap(bands, pairs, e + k * LMPI_LANES, axis[k], radial[k]);
    basis_columns_wide(bands, axis, radial, out->at + e, out->stride);
}

static LMPI_NOINLINE void project_block(int bands, const lmpi_kernel_pairs *pairs, size_t e,
                                        size_t count, const lmpi_kernel_out *out) {
    vf axis[3], radial[LMP_BANDS_MAX];
    project_cap(bands, pairs, e, axis, radial);
    basis_put(bands, axis, radial, out, e, count);
}

/* Prepares the caps of some blocks at once: a root, a quotient and the recurrence of R_l depend on
 * one another, and only other blocks can fill the wait. */
LMPI_INLINE void project_bands(int bands, int constant, const lmpi_kernel_pairs *pairs,
                               size_t count, const lmpi_kernel_out *out) {
    for (size_t e = 0; constant && e < count; e += BASIS_BLOCKS * LMPI_LANES) {
        vf axis[BASIS_BLOCKS][3], radial[BASIS_BLOCKS][BASIS_STRAIGHT];
        size_t blocks = 0;
        LMPI_ROLLED for (size_t i = e; i < count && blocks < BASIS_BLOCKS;
                         i += LMPI_LANES, blocks++)
            project_cap(bands, pairs, i, axis[blocks], radial[blocks]);
        LMPI_ROLLED for (size_t k = 0; k < blocks; k++)
            basis_put_straight(bands, axis[k], radial[k], out, e + k * LMPI_LANES, count);
    }
}

static LMPI_NOINLINE void project_straight(int bands, const lmpi_kernel_pairs *pairs, size_t count,
                                           const lmpi_kernel_out *out) {
    BASIS_SPECIALISE(bands, project_bands, pairs, count, out)
}

static void kernel_project(int bands, const lmpi_kernel_pairs *pairs, size_t count,
                           const lmpi_kernel_out *out) {
    size_t e = 0;
    if (bands <= BASIS_STRAIGHT) {
        project_straight(bands, pairs, count, out);
        return;
    }
    for (; put_wide(out, e, count); e += BASIS_BLOCKS * LMPI_LANES)
        project_wide(bands, pairs, e, out);
    for (; e < count; e += LMPI_LANES)
        project_block(bands, pairs, e, count, out);
}

/* Computes zonal coefficients, L_l0 along the axis: radial_l Y_l0(z) (paper Eq. 12 and 13), of some
 * registers of pairs side by side. A constant number of bands goes to rows from registers. */
LMPI_INLINE void zonal_blocks(int blocks, int bands, int constant, const float *radius,
                              const float *distance, size_t element, size_t count,
                              const lmpi_kernel_out *out) {
    vf memory[CAP_SIDE_BY_SIDE][LMP_BANDS_MAX], *radial[CAP_SIDE_BY_SIDE];
    float LMPI_ALIGNED block[LMP_BANDS_MAX * LMPI_LANES];
    cap_lanes cap[CAP_SIDE_BY_SIDE];
    LMPI_UNROLL for (int k = 0; k < blocks; k++) {
        const size_t e = element + (size_t)k * LMPI_LANES;
        cap[k] = cap_from_distance(vf_load(distance + e), vf_load(radius + e));
        radial[k] = memory[k];
    }
    cap_radials(blocks, bands, cap, vf_set(LMPI_KERNEL_PI), radial);
    LMPI_UNROLL for (int k = 0; k < blocks; k++) {
        const size_t e = element + (size_t)k * LMPI_LANES, live = layout_live(count, e);
        if (LMPI_LANES > 1 && constant && bands >= 3 && !out->planar && live == LMPI_LANES) {
            LMPI_UNROLL for (int l = 0; l < bands; l++) radial[k][l] *= lmpi_table_pole[l];
            layout_write(bands, radial[k], out->at + e * out->stride, out->stride);
            continue;
        }
        const int direct = out->planar && live == LMPI_LANES;
        float *to = direct ? out->at + e : block;
        const size_t stride = direct ? out->stride : LMPI_LANES;
        LMPI_UNROLL for (int l = 0; l < bands; l++)
            vf_store(to + (size_t)l * stride, radial[k][l] * lmpi_table_pole[l]);
        if (!direct)
            layout_put(block, 0, (size_t)bands, out, e, live);
    }
}

/* Few bands wait little, and straight-line code of one register is short. */
LMPI_INLINE void zonal_bands(int bands, int constant, const float *radius, const float *distance,
                             size_t count, const lmpi_kernel_out *out) {
    const size_t side = CAP_SIDE_BY_SIDE * LMPI_LANES;
    size_t e = 0;
    if (!constant)
        for (; e + side <= count; e += side)
            zonal_blocks(CAP_SIDE_BY_SIDE, bands, 0, radius, distance, e, count, out);
    for (; e < count; e += LMPI_LANES)
        zonal_blocks(1, bands, constant, radius, distance, e, count, out);
}

static void kernel_zonal(int bands, const float *radius, const float *distance, size_t count,
                         const lmpi_kernel_out *out) {
    BASIS_SPECIALISE(bands, zonal_bands, radius, distance, count, out)
}

#endif
