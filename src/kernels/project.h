/* SPDX-License-Identifier: MIT */
/* project.h - the kernels that write what they compute: basis, zonal coefficients, sphere lights.
 */
#ifndef LAMPION_KERNELS_PROJECT_H
#define LAMPION_KERNELS_PROJECT_H

#include "src/kernels/basis.h"
#include "src/kernels/cap.h"

LMP_INLINE void eval_bands(int bands, int constant, const lmp_kernel_vec3 *directions, size_t count,
                           const lmp_kernel_out *out) {
    for (size_t e = 0; e < count; e += BASIS_BLOCKS * LMP_LANES) {
        vf axis[BASIS_BLOCKS][3];
        int blocks = 0;
        LMP_ROLLED for (size_t i = e; i < count && blocks < BASIS_BLOCKS; i += LMP_LANES) {
            axis[blocks][0] = vf_load(directions->x + i);
            axis[blocks][1] = vf_load(directions->y + i);
            axis[blocks][2] = vf_load(directions->z + i);
            blocks++;
        }
        basis_put(bands, constant, blocks, axis, NULL, out, e, count);
    }
}

static void kernel_eval(int bands, const lmp_kernel_vec3 *directions, size_t count,
                        const lmp_kernel_out *out) { BASIS_SPECIALISE(bands, eval_bands, directions,
                                                                      count, out) }

/* Caps are prepared for some blocks at once: a root, a quotient and the recurrence of R_l depend on
 * one another, and only other blocks can fill the wait. */
LMP_INLINE void project_bands(int bands, int constant, const lmp_kernel_pairs *pairs, size_t count,
                              const lmp_kernel_out *out) {
    for (size_t e = 0; e < count; e += BASIS_BLOCKS * LMP_LANES) {
        vf axis[BASIS_BLOCKS][3], radial[BASIS_BLOCKS][LMP_BANDS_MAX];
        int blocks = 0;
        LMP_ROLLED for (size_t i = e; i < count && blocks < BASIS_BLOCKS; i += LMP_LANES) {
            cap_lanes cap = cap_from(vf_load(pairs->center.x + i) - vf_load(pairs->point.x + i),
                                     vf_load(pairs->center.y + i) - vf_load(pairs->point.y + i),
                                     vf_load(pairs->center.z + i) - vf_load(pairs->point.z + i),
                                     vf_load(pairs->radius + i), 0);
            cap_axis(&cap);
            axis[blocks][0] = cap.x;
            axis[blocks][1] = cap.y;
            axis[blocks][2] = cap.z;
            cap_radial(bands, &cap, vf_set(LMP_KERNEL_PI), radial[blocks]);
            blocks++;
        }
        basis_put(bands, constant, blocks, axis, radial, out, e, count);
    }
}

static void kernel_project(int bands, const lmp_kernel_pairs *pairs, size_t count,
                           const lmp_kernel_out *out) { BASIS_SPECIALISE(bands, project_bands,
                                                                         pairs, count, out) }

/* The zonal coefficient is L_l0 along the axis: radial_l Y_l0(z) (paper Eq. 12 and 13). */
LMP_INLINE void zonal_bands(int bands, int constant, const float *radius, const float *distance,
                            size_t count, const lmp_kernel_out *out) {
    (void)constant;
    for (size_t e = 0; e < count; e += LMP_LANES) {
        vf radial[LMP_BANDS_MAX];
        const cap_lanes cap = cap_from_distance(vf_load(distance + e), vf_load(radius + e));
        cap_radial(bands, &cap, vf_set(LMP_KERNEL_PI), radial);
        float LMP_ALIGNED block[LMP_BANDS_MAX * LMP_LANES];
        const size_t live = layout_live(count, e);
        const int direct = out->planar && live == LMP_LANES;
        float *to = direct ? out->at + e : block;
        const size_t stride = direct ? out->stride : LMP_LANES;
        LMP_UNROLL for (int l = 0; l < bands; l++)
            vf_store(to + (size_t)l * stride, radial[l] * lmp_table_pole[l]);
        if (!direct)
            layout_put(block, 0, (size_t)bands, out, e, live);
    }
}

static void kernel_zonal(int bands, const float *radius, const float *distance, size_t count,
                         const lmp_kernel_out *out) {
    BASIS_SPECIALISE(bands, zonal_bands, radius, distance, count, out)
}

#endif
