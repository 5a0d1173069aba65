/* SPDX-License-Identifier: MIT */
/* Xu et al., Anisotropic Spherical Gaussians (SIGGRAPH Asia 2013): the distribution of normals,
 * seen in directions of light, is longer along the plane of incidence than across it at grazing
 * views. */
#include "app/truth/scoreboard_gaussian.h"

float formula_anisotropic(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    const gaussian light = gaussian_of_light(q);
    const float diffuse = gaussian_diffuse(&light, q->normal);
    if (q->material == RULER_LAMBERT)
        return q->color * diffuse;
    const float nv = fmaxf(vec_dot(q->normal, q->view), 1e-4f), alpha = q->roughness * q->roughness;
    const lmp_vec3 z = gltf_mirror(q);
    const lmp_vec3 x = vec_normalize(vec_cross(q->normal, z), vec_across(z)), y = vec_cross(z, x);
    /* the lobe around the mirror direction: exp(-along (w·y)² - across (w·x)²), y in the plane of
     * incidence */
    const float sharpness = 2 / (alpha * alpha), nu = light.sharpness / 2;
    const float across = sharpness / (8 * nv * nv), along = sharpness / 8;
    const float amplitude =
        light.amplitude / (PI * alpha * alpha) * PI / sqrtf((nu + across) * (nu + along));
    const float sum = amplitude * gltf_clamp(vec_dot(z, q->light)) *
                      expf(-nu * across / (nu + across) * gltf_square(vec_dot(x, q->light)) -
                           nu * along / (nu + along) * gltf_square(vec_dot(y, q->light)));
    /* the other factors where the product peaks, approximately: with the harmonic mean as a single
     * sharpness */
    const float mean = 4 * along * across / (along + across);
    const lmp_vec3 axis =
        gltf_unit(vec_add(vec_scale(z, mean), vec_scale(q->light, light.sharpness)));
    const float nl = fmaxf(vec_dot(q->normal, axis), 0);
    const float vh = vec_dot(q->view, gltf_unit(vec_add(q->view, axis)));
    const float specular = sum * gltf_visibility(alpha, nl, nv) * nl;
    return gltf_layers(q, specular * gltf_schlick(gltf_f0(q), vh), diffuse, q->light);
}
