/* SPDX-License-Identifier: MIT */
#define LMPI_BATCH 128

#include "src/kernels/batch.h"
#include "src/kernels/dispatch.h"
#include "src/sh/layout.h"
#include "src/sphere/sphere.h"

#include <lampion/sphere.h>

typedef struct batch_pairs {
    lmpi_batch_room center, point;
    lmpi_batch_plane radius;
} batch_pairs;

void lmp_sphere_project_zonal_n(int bands, lmp_float_array radii, lmp_float_array distances,
                                size_t count, lmp_sh_array zonal) {
    assert(lmpi_is_bands(bands) && lmpi_is_sh_array(zonal, (size_t)bands, count));
    assert(lmpi_are_within(radii, count, 0, LMP_LENGTH_MAX));
    assert(lmpi_are_within(distances, count, 0, LMP_LENGTH_MAX));
    const lmpi_kernels *kernels = lmpi_kernels_get();
    lmpi_batch_plane radius, distance;
    for (size_t first = 0; first < count; first += LMPI_BATCH) {
        const size_t n = lmpi_batch_count(count, first);
        const lmpi_kernel_out out = lmpi_sh_array_from(zonal, (size_t)bands, count, first);
        const float *r = lmpi_batch_floats(radii.at, radii.stride, first, n, radius.at);
        const float *d = lmpi_batch_floats(distances.at, distances.stride, first, n, distance.at);
        kernels->light.zonal(bands, r, d, n, &out);
    }
}

void lmp_sphere_project_n(int bands, const lmp_spheres *spheres, lmp_vec3_array points,
                          size_t count, lmp_sh_array sh) {
    assert(lmpi_is_bands(bands) && lmpi_is_sh_array(sh, LMP_SH_COUNT(bands), count));
    assert(lmpi_are_spheres(spheres, count) && lmpi_are_finite(points, count));
    const lmpi_kernels *kernels = lmpi_kernels_get();
    const lmpi_kernel_out all = lmpi_sh_array_all(sh, LMP_SH_COUNT(bands), count);
    const bool streams = lmpi_batch_streams(&all, LMP_SH_COUNT(bands), count);
    batch_pairs planes;
    for (size_t first = 0, n; first < count; first += n) {
        n = lmpi_batch_chunk(&all, streams, count, first);
        const lmpi_kernel_out out = lmpi_batch_from(&all, first);
        const lmpi_kernel_pairs pairs = {
            lmpi_batch_vectors(&spheres->center, first, n, lmpi_batch_in(&planes.center)),
            lmpi_batch_vectors(&points, first, n, lmpi_batch_in(&planes.point)),
            lmpi_batch_floats(spheres->radius.at, spheres->radius.stride, first, n,
                              planes.radius.at)
        };
        (streams ? kernels->light.project_streamed : kernels->light.project)(bands, &pairs, n,
                                                                             &out);
    }
    if (streams)
        lmpi_batch_fence();
}

/* Copies sphere `sphere` and point `point` to element i. */
static void batch_pair(const lmp_spheres *spheres, size_t sphere, const lmp_vec3_array *points,
                       size_t point, size_t i, batch_pairs *pairs) {
    lmpi_batch_load(&spheres->center, sphere, lmpi_batch_in(&pairs->center), i);
    lmpi_batch_load(points, point, lmpi_batch_in(&pairs->point), i);
    pairs->radius.at[i] = lmpi_element(spheres->radius.at, spheres->radius.stride, sphere);
}

void lmp_sphere_project_all_n(int bands, const lmp_spheres *spheres, size_t sphere_count,
                              lmp_vec3_array points, size_t point_count, lmp_sh_array sh) {
    assert(lmpi_is_bands(bands));
    assert(lmpi_are_spheres(spheres, sphere_count) && lmpi_are_finite(points, point_count));
    const size_t count = sphere_count * point_count;
    assert(lmpi_is_sh_array(sh, LMP_SH_COUNT(bands), count));
    const lmpi_kernels *kernels = lmpi_kernels_get();
    const lmpi_kernel_out all = lmpi_sh_array_all(sh, LMP_SH_COUNT(bands), count);
    const bool streams = lmpi_batch_streams(&all, LMP_SH_COUNT(bands), count);
    size_t sphere = 0, point = 0;
    /* Zeroed, because the lanes past the last pair are read too. */
    batch_pairs planes = { 0 };
    const lmpi_kernel_pairs pairs = { lmpi_batch_planes(lmpi_batch_in(&planes.center)),
                                      lmpi_batch_planes(lmpi_batch_in(&planes.point)),
                                      planes.radius.at };
    for (size_t first = 0, n; first < count; first += n) {
        n = lmpi_batch_chunk(&all, streams, count, first);
        const lmpi_kernel_out out = lmpi_batch_from(&all, first);
        for (size_t i = 0; i < n; i++) {
            batch_pair(spheres, sphere, &points, point, i, &planes);
            if (++sphere == sphere_count) {
                sphere = 0;
                point++;
            }
        }
        (streams ? kernels->light.project_streamed : kernels->light.project)(bands, &pairs, n,
                                                                             &out);
    }
    if (streams)
        lmpi_batch_fence();
}

static lmpi_kernel_lights lights_of(const lmp_spheres *spheres, size_t count) {
    assert(lmpi_are_spheres(spheres, count));
    return (lmpi_kernel_lights) { .center = spheres->center,
                                  .radius = spheres->radius,
                                  .radiance = spheres->radiance,
                                  .count = count };
}

/* Sums all spheres at all points, with gradients where they are asked for. Neither lights nor
 * points are copied: a register of members that were stored one by one would wait for them. */
static void sum_all(const lmp_scratch *scratch, int bands, lmpi_kernel_lights *lights,
                    const lmp_vec3_array *points, size_t point_count, lmp_sh_array sh,
                    const lmp_sh_array *gradient) {
    const size_t values = LMP_SH_COUNT(bands);
    assert(lmpi_is_bands(bands) && lmpi_is_scratch(scratch));
    assert(lmpi_is_sh_array(sh, 3 * values, point_count));
    assert(lmpi_are_finite(*points, point_count));
    const lmpi_kernels *kernels = lmpi_kernels_get();
    const float *visibility = lights->visibility;
    lmpi_batch_room room;
    for (size_t first = 0; first < point_count; first += LMPI_BATCH) {
        const size_t n = lmpi_batch_count(point_count, first);
        const lmpi_kernel_vec3 vectors = lmpi_batch_vectors(points, first, n, lmpi_batch_in(&room));
        const lmpi_kernel_out out = lmpi_sh_array_from(sh, 3 * values, point_count, first);
        if (visibility)
            lights->visibility = visibility + first;
        if (!gradient) {
            kernels->light.accumulate(scratch, bands, lights, &vectors, n, &out);
            continue;
        }
        const lmpi_kernel_out slopes =
            lmpi_sh_array_from(*gradient, 9 * values, point_count, first);
        kernels->light.gradient(scratch, bands, lights, &vectors, LMP_COS_MIN, n, &out, &slopes);
    }
}

void lmp_sphere_sum_n(const lmp_scratch *scratch, int bands, const lmp_spheres *spheres,
                      size_t sphere_count, const float *visibility, lmp_vec3_array points,
                      size_t point_count, lmp_sh_array sh) {
    lmpi_kernel_lights lights = lights_of(spheres, sphere_count);
    lights.visibility = visibility;
    lights.visibility_stride = point_count;
    sum_all(scratch, bands, &lights, &points, point_count, sh, NULL);
}

void lmp_sphere_sum_gradient_n(const lmp_scratch *scratch, int bands, const lmp_spheres *spheres,
                               size_t sphere_count, lmp_vec3_array points, size_t point_count,
                               lmp_sh_array sh, lmp_sh_array gradient) {
    assert(lmpi_is_sh_array(gradient, 9 * LMP_SH_COUNT(bands), point_count));
    lmpi_kernel_lights lights = lights_of(spheres, sphere_count);
    sum_all(scratch, bands, &lights, &points, point_count, sh, &gradient);
}
