/* SPDX-License-Identifier: MIT */
/* transfers.h - transfers of lists drawn at random, for their tests. */
#ifndef LAMPION_TRANSFERS_H
#define LAMPION_TRANSFERS_H

#include "tests/oracle/check.h"

#include <lampion/lampion.h>

enum { SURFELS = 600, SKY = 5, RAYS = 13, LINKS = 3, PROBES = 4, PROBE_RAYS = 40 };

/* The arrays of a desc and of a frame's light. */
typedef struct transfer_lists {
    lmp_transfer_surfel surfels[SURFELS];
    uint32_t hits[SURFELS * RAYS], links[SURFELS * LINKS], probe_hits[PROBES * PROBE_RAYS];
    lmp_vec3 directions[PROBE_RAYS];
    lmp_rgb direct[SURFELS], emission[SURFELS], sky[SKY];
} transfer_lists;

static inline uint32_t transfer_random_index(size_t count) {
    return (uint32_t)(check_random() * (double)count);
}

static inline lmp_rgb transfer_random_color(double high) {
    const float red = (float)check_random_between(0, high),
                green = (float)check_random_between(0, high);
    return (lmp_rgb) { red, green, (float)check_random_between(0, high) };
}

/* Every fifth ray hits nothing. */
static inline uint32_t transfer_random_source(size_t surfels) {
    return check_random() < 0.2 ? LMP_TRANSFER_NONE : transfer_random_index(surfels + SKY);
}

/* Draws the lists of so many surfels, with albedos up to the one given. */
static inline void transfer_draw(size_t surfels, double albedo, transfer_lists *l) {
    for (size_t i = 0; i < surfels; i++) {
        l->surfels[i].position = (lmp_vec3) { (float)i, 0, 0 };
        l->surfels[i].normal = check_random_direction();
        l->surfels[i].albedo = transfer_random_color(albedo);
        l->surfels[i].radius = 1.5f;
        l->direct[i] = transfer_random_color(3);
        l->emission[i] = transfer_random_color(1);
    }
    for (size_t i = 0; i < surfels * RAYS; i++)
        l->hits[i] = transfer_random_source(surfels);
    for (size_t i = 0; i < surfels * LINKS; i++)
        l->links[i] = check_random() < 0.2 ? LMP_TRANSFER_NONE : transfer_random_index(surfels);
    for (size_t i = 0; i < PROBES * PROBE_RAYS; i++)
        l->probe_hits[i] = transfer_random_source(surfels);
    for (size_t i = 0; i < PROBE_RAYS; i++)
        l->directions[i] = check_random_direction();
    for (size_t i = 0; i < SKY; i++)
        l->sky[i] = transfer_random_color(2);
}

static inline lmp_transfer_desc transfer_desc_of(const transfer_lists *l, size_t surfels) {
    return (lmp_transfer_desc) { .surfels = l->surfels,
                                 .surfel_count = surfels,
                                 .sky_count = SKY,
                                 .hits = l->hits,
                                 .ray_count = RAYS,
                                 .links = l->links,
                                 .link_count = LINKS,
                                 .probe_directions = l->directions,
                                 .probe_hits = l->probe_hits,
                                 .probe_count = PROBES,
                                 .probe_ray_count = PROBE_RAYS };
}

static inline lmp_transfer *transfer_make(const lmp_transfer_desc *desc) {
    lmp_transfer *transfer;
    assert_int_equal(lmp_transfer_create(NULL, desc, &transfer), LMP_OK);
    return transfer;
}

static inline lmp_transfer_lighting transfer_lighting_of(const transfer_lists *l) {
    return (lmp_transfer_lighting) { l->direct, l->emission, l->sky };
}

static inline void transfer_iterate(lmp_transfer *transfer, int iterations,
                                    const lmp_transfer_lighting *lighting) {
    const lmp_transfer_settings settings = { .iterations = iterations };
    assert_int_equal(lmp_transfer_update(NULL, transfer, &settings, lighting), LMP_OK);
}

static inline void transfer_copy(const lmp_transfer *transfer, size_t count, lmp_rgb *rgb) {
    lmp_transfer_copy_irradiance_n(transfer, 0, count, lmp_rgb_array_of(rgb));
}

#endif
