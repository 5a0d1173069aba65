/* SPDX-License-Identifier: MIT */
#include "src/kernels/batch.h"
#include "src/kernels/dispatch.h"
#include "src/sh/layout.h"
#include "src/sphere/sphere.h"

#include <lampion/lobe.h>

void lmp_lobe_response_n(int bands, const float *lambda, lmp_vec3_array axes,
                         const lmp_spheres *spheres, size_t sphere_count, lmp_vec3_array points,
                         size_t point_count, lmp_rgb_array rgb) {
    assert(lmpi_is_bands(bands) && lmpi_is_rgb_array(rgb));
    assert(lmpi_are_unit(axes, point_count) && lmpi_are_finite(points, point_count));
    assert(lmpi_are_spheres(spheres, sphere_count));
    const lmpi_kernels *kernels = lmpi_kernels_get();
    const lmpi_kernel_lights lights = { .center = spheres->center,
                                        .radius = spheres->radius,
                                        .radiance = spheres->radiance,
                                        .count = sphere_count };
    lmpi_batch_room point_room, axis_room;
    for (size_t first = 0; first < point_count; first += LMPI_BATCH) {
        const size_t n = lmpi_batch_count(point_count, first);
        const lmpi_kernel_vec3 at =
            lmpi_batch_vectors(&points, first, n, lmpi_batch_in(&point_room));
        const lmpi_kernel_vec3 around =
            lmpi_batch_vectors(&axes, first, n, lmpi_batch_in(&axis_room));
        const lmpi_kernel_out out = lmpi_batch_out(rgb.at, 3, point_count, 0, rgb.stride, first);
        kernels->lobe.response(bands, lambda, &around, &lights, &at, n, &out);
    }
}
