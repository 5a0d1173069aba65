/* SPDX-License-Identifier: MIT */
/* Wang et al., All-Frequency Rendering of Dynamic, Spatially-Varying Reflectance (SIGGRAPH Asia
 * 2009): the light and the distribution of normals are spherical Gaussians, amplitude exp(sharpness
 * (axis·w - 1)), whose product has a closed integral. Diffuse light uses the fit of Hill (2016), SG
 * Series. */
#include "app/truth/scoreboard_gaussian.h"

/* Returns the Gaussian with the light's flux and mean cosine (Banerjee et al. 2005); 1 - cos a is
 * computed without cancellation. */
gaussian gaussian_of_light(const formula_query *q) {
    const float cosine = sqrtf(1 - q->sine * q->sine), rest = q->sine * q->sine / (1 + cosine) / 2;
    const float mean = 1 - rest, sharpness = mean * (3 - mean * mean) / (rest * (2 - rest));
    return (gaussian) { q->light, sharpness, 2 * rest * sharpness / (1 - expf(-2 * sharpness)) };
}

float gaussian_diffuse(const gaussian *light, lmp_vec3 normal) {
    const float c0 = 0.36f, c1 = 1 / (4 * c0), inverse = 1 / light->sharpness;
    const float e1 = expf(-light->sharpness), e2 = e1 * e1, cosine = vec_dot(light->axis, normal);
    const float scale = 1 + 2 * e2 - inverse, bias = (e1 - e2) * inverse - e2;
    const float x = sqrtf(fmaxf(1 - scale, 1e-12f)), x0 = c0 * cosine, x1 = c1 * x;
    const float y = fabsf(x0) <= x1 ? gltf_square(x0 + x1) / x : gltf_clamp(cosine);
    return 2 * light->amplitude * inverse * (scale * y + bias);
}

/* Integrates the product of two Gaussians; *axis is that of the product. */
static float product(const gaussian *a, const gaussian *b, lmp_vec3 *axis) {
    const lmp_vec3 sum =
        vec_add(vec_scale(a->axis, a->sharpness), vec_scale(b->axis, b->sharpness));
    const lmp_vec3 apart = vec_sub(a->axis, b->axis);
    const float length = vec_length(sum), all = a->sharpness + b->sharpness;
    const float below = a->sharpness * b->sharpness * vec_dot(apart, apart) / (all + length);
    *axis = vec_scale(sum, 1 / length);
    return 2 * PI * a->amplitude * b->amplitude * expf(-below) * (1 - expf(-2 * length)) / length;
}

float formula_gaussian(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    const gaussian light = gaussian_of_light(q);
    const float nv = vec_dot(q->normal, q->view), alpha = q->roughness * q->roughness;
    lmp_vec3 axis;
    if (q->material == RULER_LAMBERT)
        return q->color * gaussian_diffuse(&light, q->normal);
    if (q->material == RULER_PHONG) {
        const gaussian lobe = { gltf_mirror(q), q->exponent, (q->exponent + 1) / (2 * PI) };
        return q->color * product(&light, &lobe, &axis);
    }
    const gaussian lobe = { gltf_mirror(q), 2 / (alpha * alpha) / (4 * fmaxf(nv, 1e-4f)),
                            1 / (PI * alpha * alpha) };
    const float sum = product(&light, &lobe, &axis), nl = vec_dot(q->normal, axis);
    const float vh = vec_dot(q->view, gltf_unit(vec_add(q->view, axis)));
    const float specular = nl > 0 ? sum * gltf_visibility(alpha, nl, nv) * nl : 0;
    return gltf_layers(q, specular * gltf_schlick(gltf_f0(q), vh),
                       gaussian_diffuse(&light, q->normal), q->light);
}
