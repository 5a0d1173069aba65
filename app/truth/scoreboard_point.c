/* SPDX-License-Identifier: MIT */
/* The light as a point at its center, with the irradiance that it gives a surface facing it: what
 * every renderer begins with. */
#include "app/truth/scoreboard_gltf.h"

float formula_point(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    const float irradiance = PI * q->sine * q->sine, nl = vec_dot(q->normal, q->light);
    if (q->material == RULER_PHONG)
        return irradiance * q->color * (q->exponent + 1) / (2 * PI) *
               powf(fmaxf(vec_dot(gltf_mirror(q), q->light), 0), q->exponent);
    if (nl <= 0)
        return 0;
    if (q->material == RULER_LAMBERT)
        return irradiance * q->color / PI * nl;
    const float alpha = q->roughness * q->roughness;
    const lmp_vec3 half_vector = gltf_unit(vec_add(q->view, q->light));
    const float specular = gltf_distribution(alpha, vec_dot(q->normal, half_vector)) *
                           gltf_visibility(alpha, nl, vec_dot(q->normal, q->view)) *
                           gltf_schlick(gltf_f0(q), vec_dot(q->view, half_vector));
    return irradiance * gltf_layers(q, specular * nl, nl / PI, q->light);
}
