/* SPDX-License-Identifier: MIT */
/* shade_tmpl.h - what the kernels that shade surfaces share (shade.h of the API): lanes are
 * surfaces, each with lobes of its own; lights are broadcast.
 *
 * Each light adds one response per lobe to a surface. That of the diffuse lobe has a closed form
 * (horizon_tmpl.h); for Phong lobes shade_zonal_tmpl.h sums bands, and preintegrated_lobe_tmpl.h
 * reads the sums from a table. */
#ifndef LAMPION_KERNELS_SHADE_TMPL_H
#define LAMPION_KERNELS_SHADE_TMPL_H

#include "src/kernels/accumulate_tmpl.h"
#include "src/kernels/cone_tmpl.h"
#include "src/kernels/fade_tmpl.h"
#include "src/kernels/horizon_lanes_tmpl.h"
#include "src/kernels/shade.h"

/* A light as surfaces see it, as a cap of at most a hemisphere: u, the cosine of its axis with the
 * normal; t = 1 - cos a; and the weight of its responses, which is t but for the light's fading and
 * sign, and for a Dirac an equally strong one. With `is_ambient` there is ambient light besides
 * (lmp_cap). Kernels keep beside it v, the cosines of the axis with that of each lobe. */
typedef struct shade_direction {
    vf u, t, weight;
    vf ambient; /* only set if is_ambient */
    int is_ambient;
} shade_direction;

/* Returns whether no light fades, which saves a branch per light. */
LMPI_INLINE int shade_are_plain(const lmpi_packed_light *lights, size_t count) {
    int plain = 1;
    for (size_t i = 0; i < count; i++)
        plain &= !(lights[i].per_reach > 0);
    return plain;
}

/* Returns the fraction of a light that a field does not hold at distance d of its center. */
LMPI_INLINE vf shade_residual(vf d, float radius, float per_reach) {
    return vf_set(1) - fade_at(d, radius, per_reach).value;
}

/* A light that is not a sphere: its axis, its t and the weight of its responses. */
typedef struct shade_other {
    vf x, y, z, t, weight;
} shade_other;

/* The weight that makes a cap of size 0 a Dirac: pi weight (2 - t) = 1/d². */
#define SHADE_DIRAC_WEIGHT (0.5f / LMPI_KERNEL_PI)

/* Finds the cap of a light that is not a sphere. It is a function of its own, by value, so that
 * spheres keep their registers. */
static LMPI_NOINLINE shade_other shade_find_other(const lmpi_packed_light *light, vf px, vf py,
                                                  vf pz) {
    const vf zero = vf_set(0), one = vf_set(1), least = vf_set(FLT_MIN);
    const lmp_vec3 at = light->at;
    if (light->fixed) {
        const int dirac = light->size < 0;
        return (shade_other) { vf_set(at.x), vf_set(at.y), vf_set(at.z),
                               vf_set(dirac ? 0 : light->size),
                               vf_set(dirac ? SHADE_DIRAC_WEIGHT : light->size) };
    }
    const vf x = at.x - px, y = at.y - py, z = at.z - pz, d2 = x * x + y * y + z * z;
    const vf d = vf_sqrt(vf_max(d2, least)), per_d = one / d;
    const vf held = vf_min(per_d, vf_set(1 / LMPI_DIRAC_DISTANCE_MIN));
    /* At the light's position the axis is z. */
    shade_other to = { vf_select_less(d2, least, zero, x * per_d),
                       vf_select_less(d2, least, zero, y * per_d),
                       vf_select_less(d2, least, one, z * per_d), zero,
                       SHADE_DIRAC_WEIGHT * (held * held) };
    if (light->form == LMPI_FORM_CONE) {
        /* Computed by quotients, as in lmp_light_find_cap: where little light comes, rounding would
         * show. */
        const vf up = vf_select_less(d2, least, one, z / d);
        to.weight = to.weight * cone_falloff(light, x / d, y / d, up);
    }
    if (light->per_reach > 0)
        to.weight = to.weight * shade_residual(d, 0, light->per_reach);
    return to;
}

/* Finds the cap of a light and sets all of `direction` but u. The axis is x, y, z of the cap
 * returned, times per_d. */
LMPI_INLINE cap_lanes shade_cap(const lmpi_packed_light *light, int plain, const vf point[3],
                                shade_direction *direction) {
    cap_lanes cap;
    if (__builtin_expect(light->form != LMPI_FORM_SPHERE, 0)) {
        const shade_other other = shade_find_other(light, point[0], point[1], point[2]);
        cap.x = other.x;
        cap.y = other.y;
        cap.z = other.z;
        cap.per_d = vf_set(1);
        direction->is_ambient = 0;
        direction->t = other.t;
        direction->weight = other.weight;
        return cap;
    }
    const vf x = light->at.x - point[0], y = light->at.y - point[1], z = light->at.z - point[2];
    cap = cap_from(x, y, z, vf_set(light->size), 0);
    vf weight = cap.t;
    if (__builtin_expect(cap.inside, 0)) {
        /* even is -1 inside, where the complementary cap is taken away from ambient light. */
        cap.per_d = cap.per_d * cap.even;
        weight = weight * cap.even;
        direction->ambient = (vf_set(1) - cap.even) * 0.5f;
    }
    if (__builtin_expect(!plain, 0) && light->per_reach > 0)
        weight =
            weight * shade_residual(vf_sqrt(x * x + y * y + z * z), light->size, light->per_reach);
    direction->is_ambient = cap.inside;
    direction->t = cap.t;
    direction->weight = weight;
    return cap;
}

LMPI_INLINE vf shade_dot(const vf a[3], const cap_lanes *cap) {
    return a[0] * cap->x + a[1] * cap->y + a[2] * cap->z;
}

/* Whether the horizon of some lane's surface cuts its cap. */
LMPI_INLINE int shade_is_cut(vf u, vf t) {
    return vf_any_less(u * u, t * (vf_set(2) - t));
}

/* Returns f of horizon_tmpl.h, the cosine u of a cap's axis with the normal, clipped by the
 * horizon. */
LMPI_INLINE vf shade_clip(vf u, vf t) {
    return vf_select_less(u * u, t * (vf_set(2) - t), horizon_between(u, t), vf_max(vf_set(0), u));
}

/* Does so as a function of its own, by value, so that surfaces whose horizon cuts no light keep
 * their registers. */
static LMPI_NOINLINE vf shade_horizon(vf u, vf t) {
    return shade_clip(u, t);
}

/* Returns f where the horizon may or may not cut the cap. NaN stays. */
LMPI_INLINE vf shade_clipped(vf u, vf t) {
    if (__builtin_expect(shade_is_cut(u, t), 0))
        return shade_horizon(u, t);
    return vf_max(vf_set(0), u);
}

/* Adds a response, red, green, blue, to what a lobe of a block of surfaces has accumulated. The
 * color is passed by its address, and spread over the lanes as it is read. */
LMPI_INLINE void shade_accumulate(const lmp_rgb *rgb, vf response, vf sums[3]) {
    sums[0] = sums[0] + rgb->r * response;
    sums[1] = sums[1] + rgb->g * response;
    sums[2] = sums[2] + rgb->b * response;
}

LMPI_INLINE void shade_planes(const lmpi_kernel_vec3 *planes, size_t e, vf to[3]) {
    to[0] = vf_load(planes->x + e);
    to[1] = vf_load(planes->y + e);
    to[2] = vf_load(planes->z + e);
}

LMPI_INLINE void shade_sums_load(float *const planes[3], size_t e, vf sums[3]) {
    for (int c = 0; c < 3; c++)
        sums[c] = vf_load(planes[c] + e);
}

LMPI_INLINE void shade_sums_store(const vf sums[3], size_t e, float *const planes[3]) {
    for (int c = 0; c < 3; c++)
        vf_store(planes[c] + e, sums[c]);
}

#endif
