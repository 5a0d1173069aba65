/* SPDX-License-Identifier: MIT */
/* shade.h - what the kernels that shade surfaces share (shade.h of the API): lanes are surfaces,
 * each with its own normal, mirror direction and exponent; lights are broadcast.
 *
 * Of each light a surface needs two numbers: what the diffuse and the Phong lobe answer to its cap.
 * shade_zonal.h sums bands, preintegrated_lobe.h reads them from a table. */
#ifndef LAMPION_KERNELS_SHADE_H
#define LAMPION_KERNELS_SHADE_H

#include "src/kernels/accumulate.h"

/* What the lobes of a block of surfaces are and see. */
typedef struct shade_block {
    vf point[3], normal[3], mirror[3];
} shade_block;

/* What of a light they need: of its cap of at most a hemisphere u and v, the cosines of its axis
 * with normal and mirror direction, and t; the weight of its answers, t but for the light's scale
 * and sign. With `everywhere`, light from all around besides (lmp_cap). */
typedef struct shade_aim {
    vf u, v, t, weight;
    vf ambient; /* set if everywhere */
    int everywhere;
} shade_aim;

/* Sets all but u and v. Of the cap, x, y, z times per_d are its axis. */
LMP_INLINE cap_lanes shade_cap(const lmp_kernel_light *light, size_t e, const vf point[3],
                               shade_aim *aim) {
    vf x = vf_set(light->x), y = vf_set(light->y), z = vf_set(light->z);
    if (light->w > 0) {
        x = x - point[0];
        y = y - point[1];
        z = z - point[2];
    }
    cap_lanes cap = cap_from(x, y, z, vf_set(light->radius), 0);
    vf weight = cap.t;
    if (__builtin_expect(cap.inside, 0)) {
        /* even is -1 inside: the complementary cap is taken away from light all around. */
        cap.per_d = cap.per_d * cap.even;
        weight = weight * cap.even;
        aim->ambient = (vf_set(1) - cap.even) * 0.5f;
    }
    if (__builtin_expect(light->scale != NULL, 0)) {
        const vf scale = vf_load(light->scale + e);
        weight = weight * scale;
        if (cap.inside)
            aim->ambient = aim->ambient * scale;
    }
    aim->everywhere = cap.inside;
    aim->t = cap.t;
    aim->weight = weight;
    return cap;
}

LMP_INLINE vf shade_dot(const vf a[3], const cap_lanes *cap) {
    return a[0] * cap->x + a[1] * cap->y + a[2] * cap->z;
}

LMP_INLINE void shade_aim_at(const lmp_kernel_light *light, size_t e, const shade_block *block,
                             shade_aim *aim) {
    const cap_lanes cap = shade_cap(light, e, block->point, aim);
    aim->u = shade_dot(block->normal, &cap) * cap.per_d;
    aim->v = shade_dot(block->mirror, &cap) * cap.per_d;
}

/* What both lobes of a block of surfaces have gathered: red, green, blue. */
typedef struct shade_sums {
    vf diffuse[3], specular[3];
} shade_sums;

LMP_INLINE void shade_gather(lmp_rgb rgb, vf diffuse, vf specular, shade_sums *sums) {
    sums->diffuse[0] = sums->diffuse[0] + rgb.r * diffuse;
    sums->diffuse[1] = sums->diffuse[1] + rgb.g * diffuse;
    sums->diffuse[2] = sums->diffuse[2] + rgb.b * diffuse;
    sums->specular[0] = sums->specular[0] + rgb.r * specular;
    sums->specular[1] = sums->specular[1] + rgb.g * specular;
    sums->specular[2] = sums->specular[2] + rgb.b * specular;
}

LMP_INLINE void shade_planes(const lmp_kernel_vec3 *planes, size_t e, vf to[3]) {
    to[0] = vf_load(planes->x + e);
    to[1] = vf_load(planes->y + e);
    to[2] = vf_load(planes->z + e);
}

LMP_INLINE void shade_sums_load(const lmp_kernel_accumulated *gathered, size_t e,
                                shade_sums *sums) {
    for (int c = 0; c < 3; c++) {
        sums->diffuse[c] = vf_load(gathered->diffuse[c] + e);
        sums->specular[c] = vf_load(gathered->specular[c] + e);
    }
}

LMP_INLINE void shade_sums_store(const shade_sums *sums, size_t e,
                                 const lmp_kernel_accumulated *gathered) {
    for (int c = 0; c < 3; c++) {
        vf_store(gathered->diffuse[c] + e, sums->diffuse[c]);
        vf_store(gathered->specular[c] + e, sums->specular[c]);
    }
}

/* All lights first, then their lobes: in one loop, the roots and quotients of a light would wait
 * for each other at its beginning. */
LMP_INLINE void shade_aim_all(const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                              size_t light_count, size_t e, shade_aim *aims) {
    shade_block block;
    const vf *normal = block.normal;
    vf *mirror = block.mirror;
    shade_planes(&surfaces->point, e, block.point);
    shade_planes(&surfaces->normal, e, block.normal);
    shade_planes(&surfaces->view, e, mirror);
    const vf twice = 2 * (normal[0] * mirror[0] + normal[1] * mirror[1] + normal[2] * mirror[2]);
    for (int i = 0; i < 3; i++)
        mirror[i] = twice * normal[i] - mirror[i];
    for (size_t i = 0; i < light_count; i++)
        shade_aim_at(&lights[i], e, &block, &aims[i]);
}

#endif
