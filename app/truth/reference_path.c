/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_path.h"

/* Continues a path from a surface: samples a direction as the surface reflects, multiplies
 * `throughput` by its weight, and describes the surface that lies there. Returns false where the
 * path ends. */
static bool continue_path(reference_path *path, const reference_surface *from, uint64_t key,
                          double throughput[3]) {
    const double u[3] = { reference_random(key, 0), reference_random(key, 1),
                          reference_random(key, 2) };
    double weight[3];
    const reference_vec w = reference_scatter(from, u, weight);
    double left = 0;
    for (int c = 0; c < 3; c++) {
        throughput[c] *= weight[c];
        left += throughput[c];
    }
    if (!(left > 0))
        return false;
    const reference_hit hit = reference_tracer_meet(path->tracer, reference_ray_origin(from, w), w);
    if (isinf(hit.distance))
        return false;
    reference_describe(path->materials, &hit, reference_scale(-1, w), &path->met);
    return true;
}

void reference_path_sample(const reference_surface *from, uint64_t key, double radiance[3],
                           void *user) {
    reference_path *path = user;
    const reference_surface *surface = from;
    double throughput[3] = { 1, 1, 1 };
    for (int i = 0; i < path->bounces; i++) {
        const uint64_t here = reference_hash(key, (uint64_t)i);
        if (!continue_path(path, surface, here, throughput))
            return;
        const reference_result direct =
            reference_estimate(&path->estimator, &path->met.surface,
                               &(reference_stop) { .samples = 1 }, reference_hash(here, 3));
        for (int c = 0; c < 3; c++)
            radiance[c] += throughput[c] * direct.mean[c];
        surface = &path->met.surface;
    }
}
