/* SPDX-License-Identifier: MIT */
/* project.h - the kernels that write what they compute: basis, zonal coefficients, sphere lights.
 */
#ifndef LAMPION_KERNELS_PROJECT_H
#define LAMPION_KERNELS_PROJECT_H

#include "src/kernels/basis.h"
#include "src/kernels/cap.h"
#include "src/kernels/stream.h"

/* BASIS_BLOCKS full blocks of any number of bands go side by side where planes take them. */
LMP_INLINE int put_wide(const lmp_kernel_out *out, size_t element, size_t count) {
    return out->planar && element + BASIS_BLOCKS * LMP_LANES <= count;
}

LMP_INLINE void eval_axis(const lmp_kernel_vec3 *directions, size_t e, vf axis[3]) {
    axis[0] = vf_load(directions->x + e);
    axis[1] = vf_load(directions->y + e);
    axis[2] = vf_load(directions->z + e);
}

LMP_INLINE lmp_kernel_vec3 project_from(const lmp_kernel_vec3 *vectors, size_t e) {
    return (lmp_kernel_vec3) { vectors->x + e, vectors->y + e, vectors->z + e };
}

static LMP_NOINLINE void eval_any(int bands, const lmp_kernel_vec3 *directions, size_t count,
                                  const lmp_kernel_out *out) {
    size_t e = 0;
    vf axis[BASIS_BLOCKS][3];
    for (; put_wide(out, e, count); e += BASIS_BLOCKS * LMP_LANES) {
        for (size_t k = 0; k < BASIS_BLOCKS; k++)
            eval_axis(directions, e + k * LMP_LANES, axis[k]);
        basis_columns_wide(bands, axis, NULL, out->at + e, out->stride);
    }
    for (; e < count; e += LMP_LANES) {
        eval_axis(directions, e, axis[0]);
        basis_put(bands, axis[0], NULL, out, e, count);
    }
}

LMP_INLINE void eval_bands(int bands, int constant, const lmp_kernel_vec3 *directions, size_t count,
                           const lmp_kernel_out *out) {
    for (size_t e = 0; constant && e < count; e += LMP_LANES) {
        vf axis[3];
        eval_axis(directions, e, axis);
        basis_put_straight(bands, axis, NULL, out, e, count);
    }
}

static LMP_NOINLINE void eval_straight(int bands, const lmp_kernel_vec3 *directions, size_t count,
                                       const lmp_kernel_out *out) {
    BASIS_SPECIALISE(bands, eval_bands, directions, count, out)
}

static void kernel_eval(int bands, const lmp_kernel_vec3 *directions, size_t count,
                        const lmp_kernel_out *out) {
    if (bands <= BASIS_STRAIGHT)
        eval_straight(bands, directions, count, out);
    else
        eval_any(bands, directions, count, out);
}

#if STREAM
static void eval_tile(int bands, const void *directions, size_t element, size_t count,
                      const lmp_kernel_out *out) {
    const lmp_kernel_vec3 at = project_from(directions, element);
    eval_straight(bands, &at, count, out);
}
#endif

static void kernel_eval_streamed(int bands, const lmp_kernel_vec3 *directions, size_t count,
                                 const lmp_kernel_out *out) {
#if STREAM
    stream_all(eval_tile, bands, directions, count, out);
#elif LMP_LANES == 16
    lmp_kernels_avx2.eval_streamed(bands, directions, count, out);
#else
    kernel_eval(bands, directions, count, out);
#endif
}

/* The axis of the cap of pair e, and the factors of its bands. */
LMP_INLINE
void project_cap(int bands, const lmp_kernel_pairs *pairs, size_t e, vf axis[3], vf *radial) {
    cap_lanes cap = cap_from(vf_load(pairs->center.x + e) - vf_load(pairs->point.x + e),
                             vf_load(pairs->center.y + e) - vf_load(pairs->point.y + e),
                             vf_load(pairs->center.z + e) - vf_load(pairs->point.z + e),
                             vf_load(pairs->radius + e), 0);
    cap_axis(&cap);
    axis[0] = cap.x;
    axis[1] = cap.y;
    axis[2] = cap.z;
    cap_radial(bands, &cap, vf_set(LMP_KERNEL_PI), radial);
}

static LMP_NOINLINE void project_wide(int bands, const lmp_kernel_pairs *pairs, size_t e,
                                      const lmp_kernel_out *out) {
    vf axis[BASIS_BLOCKS][3], radial[BASIS_BLOCKS][LMP_BANDS_MAX];
    LMP_ROLLED for (size_t k = 0; k < BASIS_BLOCKS; k++)
        project_cap(bands, pairs, e + k * LMP_LANES, axis[k], radial[k]);
    basis_columns_wide(bands, axis, radial, out->at + e, out->stride);
}

static LMP_NOINLINE void project_block(int bands, const lmp_kernel_pairs *pairs, size_t e,
                                       size_t count, const lmp_kernel_out *out) {
    vf axis[3], radial[LMP_BANDS_MAX];
    project_cap(bands, pairs, e, axis, radial);
    basis_put(bands, axis, radial, out, e, count);
}

/* Caps are prepared for some blocks at once: a root, a quotient and the recurrence of R_l depend on
 * one another, and only other blocks can fill the wait. */
LMP_INLINE void project_bands(int bands, int constant, const lmp_kernel_pairs *pairs, size_t count,
                              const lmp_kernel_out *out) {
    for (size_t e = 0; constant && e < count; e += BASIS_BLOCKS * LMP_LANES) {
        vf axis[BASIS_BLOCKS][3], radial[BASIS_BLOCKS][BASIS_STRAIGHT];
        size_t blocks = 0;
        LMP_ROLLED for (size_t i = e; i < count && blocks < BASIS_BLOCKS; i += LMP_LANES, blocks++)
            project_cap(bands, pairs, i, axis[blocks], radial[blocks]);
        LMP_ROLLED for (size_t k = 0; k < blocks; k++)
            basis_put_straight(bands, axis[k], radial[k], out, e + k * LMP_LANES, count);
    }
}

static LMP_NOINLINE void project_straight(int bands, const lmp_kernel_pairs *pairs, size_t count,
                                          const lmp_kernel_out *out) {
    BASIS_SPECIALISE(bands, project_bands, pairs, count, out)
}

static void kernel_project(int bands, const lmp_kernel_pairs *pairs, size_t count,
                           const lmp_kernel_out *out) {
    size_t e = 0;
    if (bands <= BASIS_STRAIGHT) {
        project_straight(bands, pairs, count, out);
        return;
    }
    for (; put_wide(out, e, count); e += BASIS_BLOCKS * LMP_LANES)
        project_wide(bands, pairs, e, out);
    for (; e < count; e += LMP_LANES)
        project_block(bands, pairs, e, count, out);
}

#if STREAM
static void project_tile(int bands, const void *inputs, size_t element, size_t count,
                         const lmp_kernel_out *out) {
    const lmp_kernel_pairs *pairs = inputs;
    const lmp_kernel_pairs at = { project_from(&pairs->center, element),
                                  project_from(&pairs->point, element), pairs->radius + element };
    project_straight(bands, &at, count, out);
}
#endif

static void kernel_project_streamed(int bands, const lmp_kernel_pairs *pairs, size_t count,
                                    const lmp_kernel_out *out) {
#if STREAM
    stream_all(project_tile, bands, pairs, count, out);
#elif LMP_LANES == 16
    lmp_kernels_avx2.project_streamed(bands, pairs, count, out);
#else
    kernel_project(bands, pairs, count, out);
#endif
}

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
