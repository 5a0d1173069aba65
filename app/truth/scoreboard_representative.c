/* SPDX-License-Identifier: MIT */
/* Karis, Real Shading in Unreal Engine 4 (SIGGRAPH 2013 course notes): the highlight of the
 * sphere's point nearest to the mirror ray, scaled by (alpha/alpha')², alpha' = alpha + r/(3d).
 * That constant makes much of its energy too high: `halved` has 2 in place of 3, as ports of it do,
 * and `widened` 0.6, the best of the values tried against the reference values. The diffuse part is
 * sphere.c. */
#include "app/truth/scoreboard_gltf.h"

/* Finds the point for a light at distance 1. */
lmp_vec3 gltf_nearest_to_mirror(const formula_query *q) {
    const lmp_vec3 mirror = gltf_mirror(q);
    const lmp_vec3 to_ray = vec_sub(vec_scale(mirror, vec_dot(q->light, mirror)), q->light);
    const float distance = vec_length(to_ray);
    return vec_add(q->light, vec_scale(to_ray, distance > q->sine ? q->sine / distance : 1));
}

static float representative(const formula_query *q, float divisor) {
    const float sin2 = q->sine * q->sine;
    const float diffuse = gltf_sphere(vec_dot(q->normal, q->light), sin2);
    if (q->material == RULER_LAMBERT)
        return q->color * diffuse;
    const lmp_vec3 light = gltf_unit(gltf_nearest_to_mirror(q)),
                   half_vector = gltf_unit(vec_add(q->view, light));
    const float alpha = q->roughness * q->roughness, wide = gltf_clamp(alpha + q->sine / divisor);
    const float nl = fmaxf(vec_dot(q->normal, light), 0);
    const float specular = gltf_distribution(alpha, vec_dot(q->normal, half_vector)) *
                           gltf_square(alpha / wide) *
                           gltf_visibility(alpha, nl, vec_dot(q->normal, q->view)) *
                           gltf_schlick(gltf_f0(q), vec_dot(q->view, half_vector));
    return gltf_layers(q, PI * sin2 * specular * nl, diffuse, light);
}

float formula_representative(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    return representative(q, 3);
}

float formula_halved(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    return representative(q, 2);
}

float formula_widened(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    return representative(q, 0.6f);
}
