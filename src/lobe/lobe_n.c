/* SPDX-License-Identifier: MIT */
#include "src/kernels/batch.h"
#include "src/light/cap.h"
#include "src/sh/layout.h"

#include <lampion/lobe.h>

void lmp_lobe_response_n(int bands, const float *lambda, lmp_vec3_array axes,
                         const lmp_spheres *spheres, size_t sphere_count, lmp_vec3_array points,
                         size_t point_count, lmp_sh_layout layout, size_t stride, float *response) {
    assert(lmp_is_bands(bands) && lmp_is_layout(layout, stride, 3, point_count));
    assert(lmp_are_unit(axes, point_count) && lmp_are_finite(points, point_count));
    assert(lmp_are_spheres(spheres, sphere_count));
    const lmp_kernels *kernels = lmp_kernels_get();
    const lmp_kernel_lights lights = { .center = spheres->center,
                                       .radius = spheres->radius,
                                       .radiance = spheres->radiance,
                                       .count = sphere_count };
    lmp_batch_room point_room, axis_room;
    for (size_t first = 0; first < point_count; first += LMP_BATCH) {
        const size_t n = lmp_batch_count(point_count, first);
        const lmp_kernel_vec3 at = lmp_batch_vectors(&points, first, n, lmp_batch_in(&point_room));
        const lmp_kernel_vec3 around = lmp_batch_vectors(&axes, first, n, lmp_batch_in(&axis_room));
        const lmp_kernel_out out =
            lmp_batch_out(response, 3, point_count, layout == LMP_SH_PLANAR, stride, first);
        kernels->lobe(bands, lambda, &around, &lights, &at, n, &out);
    }
}
