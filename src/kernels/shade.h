/* SPDX-License-Identifier: MIT */
/* shade.h - what the kernels that shade surfaces share (shade.h of the API): lanes are surfaces,
 * each with lobes of its own; lights are broadcast.
 *
 * Of each light a surface needs a number per lobe. That of the diffuse lobe has a closed form
 * (horizon.h); of Phong lobes shade_zonal.h sums bands, and preintegrated_lobe.h reads the sums
 * from a table. */
#ifndef LAMPION_KERNELS_SHADE_H
#define LAMPION_KERNELS_SHADE_H

#include "src/kernels/accumulate.h"
#include "src/kernels/cone.h"
#include "src/kernels/fade.h"
#include "src/kernels/horizon.h"

/* What of a light they need: of its cap of at most a hemisphere u, the cosine of its axis with the
 * normal, and t; the weight of its responses, t but for the light's fading and sign, and of a Dirac
 * what is as strong. With `is_ambient`, ambient light besides (lmp_cap). Beside it v, the cosines
 * of the axis with that of each lobe. */
typedef struct shade_direction {
    vf u, t, weight;
    vf ambient; /* set if is_ambient */
    int is_ambient;
} shade_direction;

/* Whether no light fades: a branch a light less. */
LMP_INLINE int shade_are_plain(const lmp_packed_light *lights, size_t count) {
    int plain = 1;
    for (size_t i = 0; i < count; i++)
        plain &= !(lights[i].per_reach > 0);
    return plain;
}

/* What a field lacks of a light at a distance d of its center. */
LMP_INLINE vf shade_lacks(vf d, float radius, float per_reach) {
    return vf_set(1) - fade_at(d, radius, per_reach).value;
}

/* The axis of a light that is no sphere, its t and the weight of its responses. */
typedef struct shade_other {
    vf x, y, z, t, weight;
} shade_other;

/* The cap of no size whose weight makes a Dirac of it, pi weight (2 - t) = 1/d². */
#define SHADE_DIRAC_WEIGHT (0.5f / LMP_KERNEL_PI)

/* A function of its own, by value, so that spheres keep their registers. */
static LMP_NOINLINE shade_other shade_find_other(const lmp_packed_light *light, vf px, vf py,
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
    const vf held = vf_min(per_d, vf_set(1 / LMP_DIRAC_DISTANCE_MIN));
    /* At the light the axis is z. */
    shade_other to = { vf_select_less(d2, least, zero, x * per_d),
                       vf_select_less(d2, least, zero, y * per_d),
                       vf_select_less(d2, least, one, z * per_d), zero,
                       SHADE_DIRAC_WEIGHT * (held * held) };
    if (light->form == LMP_FORM_CONE) {
        /* By quotients, as lmp_light_cap: where little comes, rounding would count. */
        const vf up = vf_select_less(d2, least, one, z / d);
        to.weight = to.weight * cone_falloff(light, x / d, y / d, up);
    }
    if (light->per_reach > 0)
        to.weight = to.weight * shade_lacks(d, 0, light->per_reach);
    return to;
}

/* Sets all but u. Of the cap, x, y, z times per_d are its axis. */
LMP_INLINE cap_lanes shade_cap(const lmp_packed_light *light, int plain, const vf point[3],
                               shade_direction *direction) {
    cap_lanes cap;
    if (__builtin_expect(light->form != LMP_FORM_SPHERE, 0)) {
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
        /* even is -1 inside: the complementary cap is taken away from ambient light. */
        cap.per_d = cap.per_d * cap.even;
        weight = weight * cap.even;
        direction->ambient = (vf_set(1) - cap.even) * 0.5f;
    }
    if (__builtin_expect(!plain, 0) && light->per_reach > 0)
        weight =
            weight * shade_lacks(vf_sqrt(x * x + y * y + z * z), light->size, light->per_reach);
    direction->is_ambient = cap.inside;
    direction->t = cap.t;
    direction->weight = weight;
    return cap;
}

LMP_INLINE vf shade_dot(const vf a[3], const cap_lanes *cap) {
    return a[0] * cap->x + a[1] * cap->y + a[2] * cap->z;
}

/* A function of its own, by value, so that surfaces whose horizon cuts no light keep their
 * registers. */
static LMP_NOINLINE vf shade_horizon(vf u, vf t) {
    return vf_select_less(u * u, t * (vf_set(2) - t), lmp_horizon_between(u, t),
                          vf_max(vf_set(0), u));
}

/* f of horizon.h: the cosine u of a cap's axis with the normal, clipped by the horizon. NaN stays.
 */
LMP_INLINE vf shade_clipped(vf u, vf t) {
    if (__builtin_expect(vf_any_less(u * u, t * (vf_set(2) - t)), 0))
        return shade_horizon(u, t);
    return vf_max(vf_set(0), u);
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
