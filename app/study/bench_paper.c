/* SPDX-License-Identifier: MIT */
/* bench_paper.c - the work of kernels by the paper's formulas, to compare their times with. */
#include "app/render/zonal.h"
#include "app/study/bench_kernels.h"

#include <math.h>
#include <string.h>

static float coefficient_sink[12 * LMP_SH_COUNT(LMP_BANDS_MAX)];

static lmp_vec3 vector_at(const lmp_vec3_array *array, size_t i) {
    const size_t step = i * array->stride / sizeof(float);
    return (lmp_vec3) { array->x[step], array->y[step], array->z[step] };
}

/* Evaluates Eq. 12 as printed, then Eq. 13, at a point moved by `shift` along x, y or z. */
static void paper_light(const bench_batch *b, size_t sphere, lmp_vec3 at, float *sh) {
    const lmp_vec3 center = vector_at(&b->spheres.center, sphere);
    const lmp_vec3 v = { center.x - at.x, center.y - at.y, center.z - at.z };
    const float d = sqrtf(v.x * v.x + v.y * v.y + v.z * v.z),
                sine = b->spheres.radius.at[sphere] / d;
    float zonal[LMP_BANDS_MAX];
    zonal_printed(b->bands, sqrtf(1 - sine * sine), zonal);
    lmp_sh_expand_zonal(b->bands, zonal, (lmp_vec3) { v.x / d, v.y / d, v.z / d }, sh);
}
void bench_paper_basis(const bench_batch *b, size_t i) {
    lmp_sh_eval(b->bands, vector_at(&b->axes, i), coefficient_sink);
}
/* Computes gradients by one-sided differences, because the paper has none. */
void bench_paper_basis_gradient(const bench_batch *b, size_t i) {
    const size_t n = LMP_SH_COUNT(b->bands);
    const float h = 0.001f;
    const lmp_vec3 w = vector_at(&b->axes, i);
    lmp_sh_eval(b->bands, w, coefficient_sink);
    for (size_t axis = 0; axis < 3; axis++) {
        float *slope = coefficient_sink + (1 + axis) * n;
        lmp_vec3 at = w;
        (&at.x)[axis] += h;
        const float length = sqrtf(at.x * at.x + at.y * at.y + at.z * at.z);
        lmp_sh_eval(b->bands, (lmp_vec3) { at.x / length, at.y / length, at.z / length }, slope);
        for (size_t v = 0; v < n; v++)
            slope[v] = (slope[v] - coefficient_sink[v]) / h;
    }
}
/* Evaluates Eq. 4: the lobe's coefficients, and three dot products with the light's. */
static void paper_respond(const bench_batch *b, lmp_vec3 axis, float rgb[3]) {
    static float lobe[LMP_SH_COUNT(LMP_BANDS_MAX)];
    lmp_lobe_project(b->bands, b->lambda, axis, lobe);
    for (size_t c = 0; c < 3; c++)
        rgb[c] = lmp_sh_dot(b->bands, b->vectors + c * LMP_SH_COUNT(b->bands), lobe);
}
void bench_paper_irradiance(const bench_batch *b, size_t i) {
    paper_respond(b, vector_at(&b->axes, i), coefficient_sink);
}
/* Evaluates as many lobes as GGX has; their direction does not affect the cost. */
void bench_paper_shade_environment(const bench_batch *b, size_t i) {
    for (size_t k = 0; k <= LMP_GGX_LOBES; k++)
        paper_respond(b, vector_at(&b->axes, i), coefficient_sink + 3 * k);
}
/* Evaluates Eq. 5 texel by texel: the basis there times the texel's color. */
static void paper_texels(const bench_batch *b, size_t texels) {
    static float basis[LMP_SH_COUNT(LMP_BANDS_MAX)];
    const size_t n = LMP_SH_COUNT(b->bands);
    for (size_t i = 0; i < texels; i++) {
        lmp_sh_eval(b->bands, vector_at(&b->axes, i), basis);
        for (size_t c = 0; c < 3; c++)
            for (size_t v = 0; v < n; v++)
                coefficient_sink[c * n + v] += b->vectors[3 * i + c] * basis[v];
    }
}
void bench_paper_cubemap(const bench_batch *b, size_t i) {
    (void)i;
    paper_texels(b, 6 * BENCH_CUBE * BENCH_CUBE / BENCH_ELEMENTS_MAX);
}
void bench_paper_panorama(const bench_batch *b, size_t i) {
    (void)i;
    paper_texels(b, BENCH_PANORAMA_WIDTH * BENCH_PANORAMA_HEIGHT / BENCH_ELEMENTS_MAX);
}
/* Evaluates the integrand of Eq. 5 for the product of Eq. 6's values. */
static float paper_square(lmp_vec3 direction, void *user) {
    const bench_batch *b = user;
    const float value = lmp_sh_reconstruct(b->bands, b->vectors, direction);
    return value * value;
}
void bench_paper_product(const bench_batch *b, size_t i) {
    bench_batch batch = *b;
    (void)i;
    lmp_sh_project_function(b->bands, (3 * b->bands - 1) / 2, paper_square, &batch,
                            coefficient_sink);
}
void bench_paper_dot(const bench_batch *b, size_t i) {
    const float *vector = b->vectors + i * LMP_SH_COUNT(b->bands);
    coefficient_sink[0] = lmp_sh_dot(b->bands, vector, vector);
}
void bench_paper_rotate(const bench_batch *b, size_t i) {
    lmp_sh_rotate(b->bands, b->matrices, b->vectors + i * LMP_SH_COUNT(b->bands), coefficient_sink);
}
void bench_paper_zonal(const bench_batch *b, size_t i) {
    const float sine = b->spheres.radius.at[i] / b->distances[i];
    zonal_printed(b->bands, sqrtf(1 - sine * sine), coefficient_sink);
}
void bench_paper_project(const bench_batch *b, size_t i) {
    paper_light(b, i, vector_at(&b->points, i), coefficient_sink);
}
static void paper_sum(const bench_batch *b, size_t lights, size_t point, lmp_vec3 shift,
                      float *sum) {
    const size_t n = LMP_SH_COUNT(b->bands);
    lmp_vec3 at = vector_at(&b->points, point);
    at = (lmp_vec3) { at.x + shift.x, at.y + shift.y, at.z + shift.z };
    memset(sum, 0, 3 * n * sizeof *sum);
    for (size_t light = 0; light < lights; light++) {
        static float sh[LMP_SH_COUNT(LMP_BANDS_MAX)];
        const lmp_vec3 rgb = vector_at(&b->spheres.radiance, light);
        paper_light(b, light, at, sh);
        for (size_t i = 0; i < n; i++) {
            sum[i] += rgb.x * sh[i];
            sum[n + i] += rgb.y * sh[i];
            sum[2 * n + i] += rgb.z * sh[i];
        }
    }
}
void bench_paper_accumulate(const bench_batch *b, size_t i) {
    paper_sum(b, BENCH_LIGHTS, i, (lmp_vec3) { 0, 0, 0 }, coefficient_sink);
}
void bench_paper_accumulate_few(const bench_batch *b, size_t i) {
    paper_sum(b, BENCH_LIGHTS_FEW, i, (lmp_vec3) { 0, 0, 0 }, coefficient_sink);
}
/* Rounds to halves by their definition: multiples of the step of the number's exponent. */
void bench_paper_pack_half(const bench_batch *b, size_t i) {
    const size_t n = 3 * LMP_SH_COUNT(b->bands);
    for (size_t v = 0; v < n; v++) {
        int exponent;
        frexpf(b->vectors[n * i + v], &exponent);
        const float step = ldexpf(1, (exponent < -13 ? -13 : exponent) - 11);
        coefficient_sink[v] = rintf(b->vectors[n * i + v] / step) * step;
    }
}
/* Computes gradients by one-sided differences, because the paper has none. */
void bench_paper_gradient(const bench_batch *b, size_t i) {
    const size_t n = 3 * LMP_SH_COUNT(b->bands);
    const float h = 0.001f;
    paper_sum(b, BENCH_LIGHTS, i, (lmp_vec3) { 0, 0, 0 }, coefficient_sink);
    for (size_t axis = 0; axis < 3; axis++) {
        float *slope = coefficient_sink + (1 + axis) * n;
        paper_sum(b, BENCH_LIGHTS, i,
                  (lmp_vec3) { axis == 0 ? h : 0, axis == 1 ? h : 0, axis == 2 ? h : 0 }, slope);
        for (size_t v = 0; v < n; v++)
            slope[v] = (slope[v] - coefficient_sink[v]) / h;
    }
}
void bench_paper_field_update(const bench_batch *b, size_t i) {
    for (int node = 0; node < BENCH_FIELD_NODES / BENCH_ELEMENTS_MAX; node++)
        bench_paper_gradient(b, i);
}
void bench_paper_lobe(const bench_batch *b, size_t i) {
    static float lobe[LMP_SH_COUNT(LMP_BANDS_MAX)];
    const size_t n = LMP_SH_COUNT(b->bands);
    paper_sum(b, BENCH_LIGHTS, i, (lmp_vec3) { 0, 0, 0 }, coefficient_sink);
    lmp_lobe_project(b->bands, b->lambda, vector_at(&b->axes, i), lobe);
    for (size_t c = 0; c < 3; c++)
        coefficient_sink[c] = lmp_sh_dot(b->bands, coefficient_sink + c * n, lobe);
}

/* Shades both lobes, or the lobe of a table. */
void bench_paper_shade(const bench_batch *b, size_t i) {
    static float lobe[LMP_SH_COUNT(LMP_BANDS_MAX)];
    const size_t n = LMP_SH_COUNT(b->bands);
    const lmp_vec3_array around[2] = { b->surfaces.normal, b->axes };
    float rgb[3] = { 0, 0, 0 };
    paper_sum(b, BENCH_LIGHTS, i, (lmp_vec3) { 0, 0, 0 }, coefficient_sink);
    for (int k = b->surfaces.material->kind == LMP_MATERIAL_TABLE ? 1 : 0; k < 2; k++) {
        lmp_lobe_project(b->bands, b->lambda, vector_at(&around[k], i), lobe);
        for (size_t c = 0; c < 3; c++)
            rgb[c] += lmp_sh_dot(b->bands, coefficient_sink + c * n, lobe);
    }
    memcpy(coefficient_sink, rgb, sizeof rgb);
}
