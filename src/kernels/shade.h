/* SPDX-License-Identifier: MIT */
/* shade.h - what the kernels that shade surfaces share (shade.h of the API): lanes are surfaces,
 * each with lobes of its own; lights are broadcast.
 *
 * Of each light a surface needs a number a lobe: what the diffuse and the Phong lobes respond to
 * its cap. shade_zonal.h sums bands, preintegrated_lobe.h reads them from a table. */
#ifndef LAMPION_KERNELS_SHADE_H
#define LAMPION_KERNELS_SHADE_H

#include "src/kernels/accumulate.h"
#include "src/kernels/fade.h"

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

/* Adds a response to what a lobe of a block of surfaces has accumulated: red, green, blue. By its
 * address, a color is spread over the lanes as it is read. */
LMP_INLINE void shade_accumulate(const lmp_rgb *rgb, vf response, vf sums[3]) {
    sums[0] = sums[0] + rgb->r * response;
    sums[1] = sums[1] + rgb->g * response;
    sums[2] = sums[2] + rgb->b * response;
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

#endif
