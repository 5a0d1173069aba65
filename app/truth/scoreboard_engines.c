/* SPDX-License-Identifier: MIT */
/* What engines ship for lights that have a size, taken from their sources (docs/scoreboard.md names
 * the commits), with glTF's distribution, masking and Fresnel term in place of theirs. Each shades
 * with a single direction of the light, which carries all of its irradiance. */
#include "app/truth/scoreboard_gltf.h"

/* Returns the specular radiance for irradiance 1 from one direction, with the distribution at the
 * cosine nh. */
static float specular_of(const formula_query *q, float nl, float nh, float vh) {
    const float alpha = q->roughness * q->roughness;
    return gltf_distribution(alpha, nh) * gltf_visibility(alpha, nl, vec_dot(q->normal, q->view)) *
           gltf_schlick(gltf_f0(q), vh) * nl;
}

/* Evaluates Bevy's formula: Karis' point nearest to the mirror ray, alpha' = alpha + r/(2d) with d
 * its distance; the cosine and the diffuse part are those of the light's center. */
float formula_bevy(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    const float irradiance = PI * q->sine * q->sine;
    const float alpha = q->roughness * q->roughness;
    const lmp_vec3 nearest = gltf_nearest_to_mirror(q), light = gltf_unit(nearest);
    const lmp_vec3 half_vector = gltf_unit(vec_add(q->view, light));
    const float wide = gltf_clamp(alpha + q->sine / (2 * vec_length(nearest)));
    const float nl = fmaxf(vec_dot(q->normal, light), 0);
    const float center = fmaxf(vec_dot(q->normal, q->light), 0);
    const float specular = gltf_distribution(alpha, vec_dot(q->normal, half_vector)) *
                           gltf_visibility(alpha, nl, vec_dot(q->normal, q->view)) *
                           gltf_schlick(gltf_f0(q), vec_dot(q->view, half_vector)) *
                           gltf_square(alpha / wide);
    return irradiance * gltf_layers(q, specular * center, center / PI, q->light);
}

/* Evaluates Filament's formula for the sun: the direction of the disk nearest to the mirror ray,
 * for both layers, without a normalization. */
float formula_filament(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    const lmp_vec3 mirror = gltf_mirror(q);
    const float along = vec_dot(q->light, mirror), cosine = sqrtf(1 - q->sine * q->sine);
    lmp_vec3 light = mirror;
    if (along < cosine) {
        const lmp_vec3 aside = vec_sub(mirror, vec_scale(q->light, along));
        light =
            gltf_unit(vec_add(vec_scale(q->light, cosine), vec_scale(gltf_unit(aside), q->sine)));
    }
    const float nl = vec_dot(q->normal, light);
    const lmp_vec3 half_vector = gltf_unit(vec_add(q->view, light));
    if (nl <= 0)
        return 0;
    const float specular =
        specular_of(q, nl, vec_dot(q->normal, half_vector), vec_dot(q->view, half_vector));
    return PI * q->sine * q->sine * gltf_layers(q, specular, nl / PI, light);
}

/* Evaluates Godot's formula: every cosine with the light direction or half vector is increased by 1
 * - cos of the half angle whose tangent is r/d, to at most 1. */
float formula_godot(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    const float more = 1 - 1 / sqrtf(1 + q->sine * q->sine);
    const lmp_vec3 half_vector = gltf_unit(vec_add(q->view, q->light));
    const float nl = gltf_clamp(more + vec_dot(q->normal, q->light));
    const float nh = gltf_clamp(more + vec_dot(q->normal, half_vector));
    const float vh = gltf_clamp(more + vec_dot(q->view, half_vector));
    return PI * q->sine * q->sine * gltf_layers(q, specular_of(q, nl, nh, vh), nl / PI, q->light);
}
