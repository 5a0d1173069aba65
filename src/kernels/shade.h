/* SPDX-License-Identifier: MIT */
/* shade.h - what the kernels that shade surfaces share (shade.h of the API): lanes are surfaces,
 * each with lobes of its own; lights are broadcast.
 *
 * Of each light a surface needs a number a lobe: what the diffuse and the Phong lobes respond to
 * its cap. shade_zonal.h sums bands, preintegrated_lobe.h reads them from a table. The number of
 * Phong lobes is a constant wherever `lobes` is passed. */
#ifndef LAMPION_KERNELS_SHADE_H
#define LAMPION_KERNELS_SHADE_H

#include "src/kernels/accumulate.h"
#include "src/kernels/fade.h"

/* Where the lobes of a block of surfaces lie and point. */
typedef struct shade_block {
    vf point[3], normal[3], axis[LMP_KERNEL_LOBES_MAX][3];
} shade_block;

/* What of a light they need: of its cap of at most a hemisphere u, the cosine of its axis with the
 * normal, and t; the weight of its responses, t but for the light's scale and sign. With
 * `is_ambient`, ambient light besides (lmp_cap). Beside it v, the cosines of the axis with that of
 * each lobe. */
typedef struct shade_direction {
    vf u, t, weight;
    vf ambient; /* set if is_ambient */
    int is_ambient;
} shade_direction;

/* Whether no light has factors of its radiance: a branch a light less. */
LMP_INLINE int shade_are_plain(const lmp_kernel_light *lights, size_t count) {
    int plain = 1;
    for (size_t i = 0; i < count; i++)
        plain &= !lights[i].scale && !(lights[i].per_reach > 0);
    return plain;
}

/* The weight of a light's responses times its factors. d: its distance. */
LMP_INLINE vf shade_scaled(const lmp_kernel_light *light, size_t e, const cap_lanes *cap, vf d,
                           vf weight, shade_direction *direction) {
    if (light->scale) {
        const vf scale = vf_load(light->scale + e);
        weight = weight * scale;
        if (cap->inside)
            direction->ambient = direction->ambient * scale;
    }
    if (light->per_reach > 0)
        weight = weight * (vf_set(1) - fade_at(d, light->radius, light->per_reach).value);
    return weight;
}

/* Sets all but u. Of the cap, x, y, z times per_d are its axis. */
LMP_INLINE cap_lanes shade_cap(const lmp_kernel_light *light, int plain, size_t e,
                               const vf point[3], shade_direction *direction) {
    vf x = vf_set(light->x), y = vf_set(light->y), z = vf_set(light->z);
    if (light->w > 0) {
        x = x - point[0];
        y = y - point[1];
        z = z - point[2];
    }
    cap_lanes cap = cap_from(x, y, z, vf_set(light->radius), 0);
    vf weight = cap.t;
    if (__builtin_expect(cap.inside, 0)) {
        /* even is -1 inside: the complementary cap is taken away from ambient light. */
        cap.per_d = cap.per_d * cap.even;
        weight = weight * cap.even;
        direction->ambient = (vf_set(1) - cap.even) * 0.5f;
    }
    if (__builtin_expect(!plain, 0))
        weight = shade_scaled(light, e, &cap, vf_sqrt(x * x + y * y + z * z), weight, direction);
    direction->is_ambient = cap.inside;
    direction->t = cap.t;
    direction->weight = weight;
    return cap;
}

LMP_INLINE vf shade_dot(const vf a[3], const cap_lanes *cap) {
    return a[0] * cap->x + a[1] * cap->y + a[2] * cap->z;
}

LMP_INLINE void shade_direction_of(int lobes, const lmp_kernel_light *light, int plain, size_t e,
                                   const shade_block *block, shade_direction *direction, vf *v) {
    const cap_lanes cap = shade_cap(light, plain, e, block->point, direction);
    direction->u = shade_dot(block->normal, &cap) * cap.per_d;
    LMP_UNROLL for (int k = 0; k < lobes; k++) v[k] = shade_dot(block->axis[k], &cap) * cap.per_d;
}

/* Adds a response to what a lobe of a block of surfaces has accumulated: red, green, blue. */
LMP_INLINE void shade_accumulate(lmp_rgb rgb, vf response, vf sums[3]) {
    sums[0] = sums[0] + rgb.r * response;
    sums[1] = sums[1] + rgb.g * response;
    sums[2] = sums[2] + rgb.b * response;
}

LMP_INLINE void shade_planes(const lmp_kernel_vec3 *planes, size_t e, vf to[3]) {
    to[0] = vf_load(planes->x + e);
    to[1] = vf_load(planes->y + e);
    to[2] = vf_load(planes->z + e);
}

LMP_INLINE void shade_sums_load(float *const planes[3], size_t e, vf sums[3]) {
    for (int c = 0; c < 3; c++)
        sums[c] = vf_load(planes[c] + e);
}

LMP_INLINE void shade_sums_store(const vf sums[3], size_t e, float *const planes[3]) {
    for (int c = 0; c < 3; c++)
        vf_store(planes[c] + e, sums[c]);
}

/* Some lights first, then their lobes: in one loop, the roots and quotients of a light would wait
 * for each other at its beginning. The v of a light follow those of the one before. */
LMP_INLINE void shade_directions(int lobes, const lmp_kernel_surfaces *surfaces,
                                 const lmp_kernel_light *lights, size_t light_count, int plain,
                                 size_t e, shade_direction *directions, vf *v) {
    shade_block block;
    shade_planes(&surfaces->point, e, block.point);
    shade_planes(&surfaces->normal, e, block.normal);
    LMP_UNROLL for (int k = 0; k < lobes; k++)
        shade_planes(&surfaces->lobe[k].axis, e, block.axis[k]);
    for (size_t i = 0; i < light_count; i++)
        shade_direction_of(lobes, &lights[i], plain, e, &block, &directions[i],
                           v + i * (size_t)lobes);
}

#endif
