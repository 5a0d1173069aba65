/* SPDX-License-Identifier: MIT */
#include "app/study/volume_bounces.h"

#include "app/render/shadow/transfer.h"
#include "app/scene/vector.h"

#include <lampion/field.h>
#include <lampion/sh.h>

#include <math.h>
#include <stdlib.h>

/* Rays of a probe, and the values of the basis in their directions. */
enum { RAYS = 512, VALUES_MAX = LMP_SH_COUNT(LMP_FIELD_BANDS_MAX) };

struct volume_bounces {
    transfer *transfer;
    lmp_vec3 directions[RAYS];
    float basis[RAYS][VALUES_MAX];
};

/* Spreads directions evenly over the sphere, by the spiral of the golden angle. */
static void spread(volume_bounces *b) {
    const double golden = M_PI * (3 - sqrt(5));
    for (int k = 0; k < RAYS; k++) {
        const double y = 1 - (2 * k + 1.0) / RAYS, r = sqrt(1 - y * y), azimuth = golden * k;
        b->directions[k] = vec((float)(r * cos(azimuth)), (float)y, (float)(r * sin(azimuth)));
        lmp_sh_eval(LMP_FIELD_BANDS_MAX, b->directions[k], b->basis[k]);
    }
}

static bool light(const scene *world, transfer *t) {
    const render_bounces bounces = transfer_bounces(t);
    const render_frame frame = { .lights = world->lights, .light_count = world->light_count };
    base_error error;
    return !bounces.begin || bounces.begin(bounces.user, &frame, &error);
}

volume_bounces *volume_bounces_create(const scene *world, const trace_bvh *bvh,
                                      const environment *around, bool shadows, int count) {
    /* Probes receive the last bounce, so that surfels need one fewer. */
    const transfer_settings settings = { .bounces = count - 1,
                                         .shadows = shadows,
                                         .around = environment_shines(around) ? around : NULL };
    base_error error;
    volume_bounces *b = malloc(sizeof *b);
    if (!b)
        return NULL;
    spread(b);
    b->transfer = transfer_create(world, NULL, bvh, &settings, &error);
    if (b->transfer && light(world, b->transfer))
        return b;
    volume_bounces_destroy(b);
    return NULL;
}

void volume_bounces_destroy(volume_bounces *b) {
    if (!b)
        return;
    transfer_destroy(b->transfer);
    free(b);
}

void volume_bounces_add(const volume_bounces *b, lmp_vec3 point, int bands, float *sh) {
    const size_t count = LMP_SH_COUNT(bands);
    const float each = (float)(4 * M_PI / RAYS);
    for (int k = 0; k < RAYS; k++) {
        const lmp_rgb radiance = transfer_radiance(b->transfer, point, b->directions[k]);
        for (size_t i = 0; i < count; i++) {
            const float value = each * b->basis[k][i];
            sh[i] += value * radiance.r;
            sh[count + i] += value * radiance.g;
            sh[2 * count + i] += value * radiance.b;
        }
    }
}
