/* SPDX-License-Identifier: MIT */
#define LMP_BATCH 128

#include "src/kernels/batch.h"
#include "src/light/cap.h"
#include "src/sh/layout.h"

#include <lampion/light.h>

typedef struct batch_pairs {
    lmp_batch_room center, point;
    lmp_batch_plane radius;
} batch_pairs;

void lmp_sphere_zonal_n(int bands, lmp_float_array radii, lmp_float_array distances, size_t count,
                        lmp_sh_layout layout, size_t stride, float *zonal) {
    assert(lmp_is_bands(bands) && lmp_is_layout(layout, stride, (size_t)bands, count));
    assert(lmp_are_within(radii, count, 0, LMP_LENGTH_MAX));
    assert(lmp_are_within(distances, count, 0, LMP_LENGTH_MAX));
    const lmp_kernels *kernels = lmp_kernels_get();
    lmp_batch_plane radius, distance;
    for (size_t first = 0; first < count; first += LMP_BATCH) {
        const size_t n = lmp_batch_count(count, first);
        const lmp_kernel_out out =
            lmp_batch_out(zonal, (size_t)bands, count, layout == LMP_SH_PLANAR, stride, first);
        const float *r = lmp_batch_floats(radii.at, radii.stride, first, n, radius.at);
        const float *d = lmp_batch_floats(distances.at, distances.stride, first, n, distance.at);
        kernels->zonal(bands, r, d, n, &out);
    }
}

void lmp_sphere_project_n(int bands, const lmp_spheres *spheres, lmp_vec3_array points,
                          size_t count, lmp_sh_layout layout, size_t stride, float *sh) {
    assert(lmp_is_bands(bands) && lmp_is_layout(layout, stride, LMP_SH_COUNT(bands), count));
    assert(lmp_are_spheres(spheres, count) && lmp_are_finite(points, count));
    const lmp_kernels *kernels = lmp_kernels_get();
    const lmp_kernel_out all =
        lmp_batch_all(sh, LMP_SH_COUNT(bands), count, layout == LMP_SH_PLANAR, stride);
    const bool streams = lmp_batch_streams(&all, LMP_SH_COUNT(bands), count);
    batch_pairs planes;
    for (size_t first = 0, n; first < count; first += n) {
        n = lmp_batch_chunk(&all, streams, count, first);
        const lmp_kernel_out out = lmp_batch_from(&all, first);
        const lmp_kernel_pairs pairs = {
            lmp_batch_vectors(&spheres->center, first, n, lmp_batch_in(&planes.center)),
            lmp_batch_vectors(&points, first, n, lmp_batch_in(&planes.point)),
            lmp_batch_floats(spheres->radius.at, spheres->radius.stride, first, n, planes.radius.at)
        };
        (streams ? kernels->project_streamed : kernels->project)(bands, &pairs, n, &out);
    }
    if (streams)
        lmp_batch_fence();
}

/* Copies sphere `sphere` and point `point` to element i. */
static void batch_pair(const lmp_spheres *spheres, size_t sphere, const lmp_vec3_array *points,
                       size_t point, size_t i, batch_pairs *pairs) {
    lmp_batch_load(&spheres->center, sphere, lmp_batch_in(&pairs->center), i);
    lmp_batch_load(points, point, lmp_batch_in(&pairs->point), i);
    pairs->radius.at[i] = lmp_element(spheres->radius.at, spheres->radius.stride, sphere);
}

void lmp_sphere_project_all(int bands, const lmp_spheres *spheres, size_t sphere_count,
                            lmp_vec3_array points, size_t point_count, lmp_sh_layout layout,
                            size_t stride, float *sh) {
    assert(lmp_is_bands(bands));
    assert(lmp_are_spheres(spheres, sphere_count) && lmp_are_finite(points, point_count));
    const size_t count = sphere_count * point_count;
    assert(lmp_is_layout(layout, stride, LMP_SH_COUNT(bands), count));
    const lmp_kernels *kernels = lmp_kernels_get();
    const lmp_kernel_out all =
        lmp_batch_all(sh, LMP_SH_COUNT(bands), count, layout == LMP_SH_PLANAR, stride);
    const bool streams = lmp_batch_streams(&all, LMP_SH_COUNT(bands), count);
    size_t sphere = 0, point = 0;
    /* Zero: the lanes past the last pair are read too. */
    batch_pairs planes = { 0 };
    const lmp_kernel_pairs pairs = { lmp_batch_planes(lmp_batch_in(&planes.center)),
                                     lmp_batch_planes(lmp_batch_in(&planes.point)),
                                     planes.radius.at };
    for (size_t first = 0, n; first < count; first += n) {
        n = lmp_batch_chunk(&all, streams, count, first);
        const lmp_kernel_out out = lmp_batch_from(&all, first);
        for (size_t i = 0; i < n; i++) {
            batch_pair(spheres, sphere, &points, point, i, &planes);
            if (++sphere == sphere_count) {
                sphere = 0;
                point++;
            }
        }
        (streams ? kernels->project_streamed : kernels->project)(bands, &pairs, n, &out);
    }
    if (streams)
        lmp_batch_fence();
}

static lmp_kernel_lights lights_of(const lmp_spheres *spheres, size_t count) {
    assert(lmp_are_spheres(spheres, count));
    return (lmp_kernel_lights) { .center = spheres->center,
                                 .radius = spheres->radius,
                                 .radiance = spheres->radiance,
                                 .count = count };
}

/* Gradients too, where there is one. Neither lights nor points are copied: a register of
 * members that were stored one by one would wait for them. */
static void accumulate_all(const lmp_scratch *scratch, int bands, lmp_kernel_lights *lights,
                           const lmp_vec3_array *points, size_t point_count, lmp_sh_layout layout,
                           size_t stride, float *sh, size_t gradient_stride, float *gradient) {
    const size_t values = LMP_SH_COUNT(bands);
    const int planar = layout == LMP_SH_PLANAR;
    assert(lmp_is_bands(bands) && lmp_is_scratch(scratch));
    assert(lmp_is_layout(layout, stride, 3 * values, point_count));
    assert(lmp_are_finite(*points, point_count));
    const lmp_kernels *kernels = lmp_kernels_get();
    const float *visibility = lights->visibility;
    lmp_batch_room room;
    for (size_t first = 0; first < point_count; first += LMP_BATCH) {
        const size_t n = lmp_batch_count(point_count, first);
        const lmp_kernel_vec3 vectors = lmp_batch_vectors(points, first, n, lmp_batch_in(&room));
        const lmp_kernel_out out =
            lmp_batch_out(sh, 3 * values, point_count, planar, stride, first);
        if (visibility)
            lights->visibility = visibility + first;
        if (!gradient) {
            kernels->accumulate(scratch, bands, lights, &vectors, n, &out);
            continue;
        }
        const lmp_kernel_out slopes =
            lmp_batch_out(gradient, 9 * values, point_count, planar, gradient_stride, first);
        kernels->gradient(scratch, bands, lights, &vectors, LMP_COS_MIN, n, &out, &slopes);
    }
}

void lmp_sphere_accumulate_n(const lmp_scratch *scratch, int bands, const lmp_spheres *spheres,
                             size_t sphere_count, lmp_vec3_array points, size_t point_count,
                             lmp_sh_layout layout, size_t stride, float *sh) {
    lmp_kernel_lights lights = lights_of(spheres, sphere_count);
    accumulate_all(scratch, bands, &lights, &points, point_count, layout, stride, sh, 0, NULL);
}

void lmp_sphere_accumulate_visible_n(const lmp_scratch *scratch, int bands,
                                     const lmp_spheres *spheres, size_t sphere_count,
                                     const float *visibility, lmp_vec3_array points,
                                     size_t point_count, lmp_sh_layout layout, size_t stride,
                                     float *sh) {
    lmp_kernel_lights lights = lights_of(spheres, sphere_count);
    lights.visibility = visibility;
    lights.visibility_stride = point_count;
    accumulate_all(scratch, bands, &lights, &points, point_count, layout, stride, sh, 0, NULL);
}

void lmp_sphere_accumulate_gradient_n(const lmp_scratch *scratch, int bands,
                                      const lmp_spheres *spheres, size_t sphere_count,
                                      lmp_vec3_array points, size_t point_count,
                                      lmp_sh_layout layout, size_t stride, float *sh,
                                      size_t gradient_stride, float *gradient) {
    assert(lmp_is_layout(layout, gradient_stride, 9 * LMP_SH_COUNT(bands), point_count));
    lmp_kernel_lights lights = lights_of(spheres, sphere_count);
    accumulate_all(scratch, bands, &lights, &points, point_count, layout, stride, sh,
                   gradient_stride, gradient);
}
