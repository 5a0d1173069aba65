/* SPDX-License-Identifier: MIT */
/* scoreboard_gltf.h - parts of glTF 2.0, appendix B, that the formulas combine. */
#ifndef LAMPION_TRUTH_SCOREBOARD_GLTF_H
#define LAMPION_TRUTH_SCOREBOARD_GLTF_H

#include "app/scene/vector.h"
#include "app/truth/scoreboard_formula.h"

static inline float gltf_square(float x) {
    return x * x;
}

static inline float gltf_clamp(float x) {
    return fminf(fmaxf(x, 0), 1);
}

static inline lmp_vec3 gltf_unit(lmp_vec3 a) {
    return vec_scale(a, 1 / vec_length(a));
}

static inline lmp_vec3 gltf_mirror(const formula_query *q) {
    return vec_sub(vec_scale(q->normal, 2 * vec_dot(q->normal, q->view)), q->view);
}

/* Evaluates GGX's distribution at the cosine of the half vector. */
static inline float gltf_distribution(float alpha, float nh) {
    const float a2 = alpha * alpha;
    return a2 / (PI * gltf_square(nh * nh * (a2 - 1) + 1));
}

/* Evaluates Smith's height-correlated masking over 4 nl nv. */
static inline float gltf_visibility(float alpha, float nl, float nv) {
    const float a2 = alpha * alpha;
    return 0.5f / (nl * sqrtf(a2 + (1 - a2) * nv * nv) + nv * sqrtf(a2 + (1 - a2) * nl * nl));
}

static inline float gltf_f0(const formula_query *q) {
    return q->material == RULER_METAL ? q->color : 0.04f;
}

static inline float gltf_schlick(float f0, float vh) {
    const float x = 1 - gltf_clamp(vh);
    return f0 + (1 - f0) * x * x * x * x * x;
}

/* Combines the layers of a metal or a dielectric: `specular` includes its Fresnel term; `diffuse`
 * is that of a white Lambert surface, of light from about `light`. */
static inline float gltf_layers(const formula_query *q, float specular, float diffuse,
                                lmp_vec3 light) {
    if (q->material == RULER_METAL)
        return specular;
    const float vh = vec_dot(q->view, gltf_unit(vec_add(q->view, light)));
    return specular + (1 - gltf_schlick(0.04f, vh)) * q->color * diffuse;
}

/* Returns the sphere's point nearest to the mirror ray (representative.c). */
lmp_vec3 gltf_nearest_to_mirror(const formula_query *q);

/* Returns the radiance of a white Lambert surface under a disk (sphere.c). */
float gltf_sphere(float cosine, float sin2);

#endif
