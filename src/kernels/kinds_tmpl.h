/* SPDX-License-Identifier: MIT */
/* kinds_tmpl.h - kernels for lights other than spheres: cones, and coefficients that are the same
 * at every point. Diracs are in cap_tmpl.h. */
#ifndef LAMPION_KERNELS_KINDS_TMPL_H
#define LAMPION_KERNELS_KINDS_TMPL_H

#include "src/kernels/cone_tmpl.h"
#include "src/kernels/layout_tmpl.h"
#include "src/kernels/light.h"

/* Weakens lights by a cone's falloff, by the operations of lmp_light_find_cap, lane by lane. */
static void kernel_cone(const lmpi_packed_light *cone, const lmpi_kernel_vec3 *points, size_t count,
                        float *factors) {
    const vf zero = vf_set(0), one = vf_set(1);
    for (size_t e = 0; e < count; e += LMPI_LANES) {
        const vf x = cone->at.x - vf_load(points->x + e);
        const vf y = cone->at.y - vf_load(points->y + e);
        const vf z = cone->at.z - vf_load(points->z + e), d = vf_sqrt(x * x + y * y + z * z);
        const vf divisor = vf_select_less(zero, d, d, one), up = vf_select_less(zero, d, z, one);
        const vf falloff = cone_falloff(cone, x / divisor, y / divisor, up / divisor);
        vf_store(factors + e, vf_load(factors + e) * falloff);
    }
}

LMPI_INLINE void kinds_add(float factor, const float *values, size_t count, float *to) {
    size_t i = 0;
    for (; i + LMPI_LANES <= count; i += LMPI_LANES)
        vf_store(to + i, vf_load(to + i) + factor * vf_load(values + i));
    for (; i < count; i++)
        to[i] = to[i] + factor * values[i];
}

static void kernel_add(const float *sh, size_t first, size_t values, const float *factors,
                       size_t count, const lmpi_kernel_out *out) {
    if (out->planar)
        for (size_t v = 0; v < values; v++)
            kinds_add(sh[v], factors, count, out->at + (first + v) * out->stride);
    else
        for (size_t e = 0; e < count; e++)
            kinds_add(factors[e], sh, values, out->at + e * out->stride + first);
}

#endif
