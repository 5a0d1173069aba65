/* SPDX-License-Identifier: MIT */
/* values.h - what the variants must compute, by the library, one number after another, and how
 * large the numbers are of which each is a sum. */
#ifndef LAMPION_TESTS_GPU_VARIANTS_VALUES_H
#define LAMPION_TESTS_GPU_VARIANTS_VALUES_H

#include "tests/gpu/variants/given.h"

#include <lampion/sh.h>

enum { FIXED_VALUES = 42, BANDS_MOST = 32 };

static int count_values(const configuration *of) {
    return FIXED_VALUES + 4 * of->bands + 2 * of->bands * of->bands;
}

/* Values of one surface that are compared as they come. */
typedef struct comparison {
    const float *value;
    double worst;     /* of the differences, in parts of the scales */
    const char *what; /* is the worst */
} comparison;

static void compare(comparison *with, const char *what, double expected, double scale) {
    const double error = fabs((double)*with->value++ - expected) / scale;
    if (!(error <= with->worst)) {
        with->worst = error;
        with->what = what;
    }
}

static void compare_rgb(comparison *with, const char *what, lmp_rgb expected, double scale) {
    compare(with, what, (double)expected.r, scale);
    compare(with, what, (double)expected.g, scale);
    compare(with, what, (double)expected.b, scale);
}

static void compare_vec3(comparison *with, const char *what, lmp_vec3 expected) {
    compare_rgb(with, what, (lmp_rgb) { expected.x, expected.y, expected.z }, 1);
}

/* The scale of an array is its largest value. */
static void compare_array(comparison *with, const char *what, const float *expected, size_t count) {
    double scale = 0;
    for (size_t i = 0; i < count; i++)
        scale = fmax(scale, fabs((double)expected[i]));
    for (size_t i = 0; i < count; i++)
        compare(with, what, (double)expected[i], scale);
}

static double largest_of(lmp_rgb c) {
    return fmax((double)c.r, fmax((double)c.g, (double)c.b));
}

/* Returns the mirror direction. */
static lmp_vec3 mirror(const lmp_surface *surface) {
    const lmp_vec3 n = surface->normal, v = surface->view;
    const float twice = 2 * (n.x * v.x + n.y * v.y + n.z * v.z);
    return (lmp_vec3) { twice * n.x - v.x, twice * n.y - v.y, twice * n.z - v.z };
}

/* Moves a light to where the surface mirrors the viewer. */
static lmp_light mirrored(const lmp_light *light, const lmp_surface *surface) {
    const lmp_vec3 p = surface->position, w = mirror(surface), at = light->position;
    const float d = sqrtf((at.x - p.x) * (at.x - p.x) + (at.y - p.y) * (at.y - p.y) +
                          (at.z - p.z) * (at.z - p.z));
    lmp_light moved = *light;
    moved.position = (lmp_vec3) { p.x + d * w.x, p.y + d * w.y, p.z + d * w.z };
    moved.direction = light->kind == LMP_LIGHT_CAP ? w : light->direction;
    return moved;
}

/* Returns the direction to a light's middle. */
static lmp_vec3 toward(const lmp_light *light, lmp_vec3 point) {
    const lmp_light middle = { .position = light->position };
    lmp_cap cap;
    lmp_light_find_cap(light->kind < LMP_LIGHT_RECTANGLE ? light : &middle, point, &cap);
    return cap.axis;
}

/* Returns what the lights would give together, each of them where it gives most: the surface and
 * its viewer face it, or it is mirrored. */
static double peak(const lmp_shade_settings *settings, const lmp_material *material,
                   const lmp_surface *surface, const lmp_light *lights, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const lmp_light moved = mirrored(&lights[i], surface);
        lmp_surface facing = *surface;
        facing.normal = facing.view = toward(&lights[i], surface->position);
        sum += fmax(largest_of(lmp_shade(settings, material, &facing, &lights[i], 1)),
                    largest_of(lmp_shade(settings, material, surface, &moved, 1)));
    }
    return sum;
}

static void compare_shaded(comparison *with, const char *what, const lmp_shade_settings *settings,
                           const lmp_material *material, const lmp_surface *surface,
                           const lmp_light *lights, int count) {
    const lmp_rgb expected = lmp_shade(settings, material, surface, lights, (size_t)count);
    /* A position in a texture of 512 texels is rounded to 3e-5 of one, in which values may double.
     */
    const double coarser = settings->method == LMP_SHADE_PREINTEGRATED ? 4 : 1;
    compare_rgb(with, what, expected,
                coarser * peak(settings, material, surface, lights, (size_t)count));
}

/* By zonal sums, by coefficients and by preintegrated lobes. */
static void compare_methods(comparison *with, lmp_shade_settings settings,
                            const lmp_material *material, const lmp_surface *surface,
                            const lmp_light *lights, int count) {
    compare_shaded(with, "zonal", &settings, material, surface, lights, count);
    settings.method = LMP_SHADE_COEFFICIENTS;
    compare_shaded(with, "coefficients", &settings, material, surface, lights, count);
    settings.method = LMP_SHADE_PREINTEGRATED;
    compare_shaded(with, "preintegrated lobe", &settings, material, surface, lights, count);
}

static void compare_irradiance(comparison *with, const configuration *of, const world *from,
                               const lmp_surface *surface) {
    const lmp_light *lights = from->lights;
    double scale = 0;
    for (int i = 0; i < LIGHTS; i++) {
        lmp_cap cap;
        lmp_light_find_cap(&lights[i], surface->position, &cap);
        scale += fabs((double)cap.strength.r) + 3.14 * (double)cap.ambient.r;
    }
    compare_rgb(with, "irradiance",
                lmp_light_irradiance(lights, LIGHTS, surface->position, surface->normal), scale);
    for (int i = 0; i < of->areas; i++) {
        lmp_light area = lights[LIGHTS + i];
        area.radiance = (lmp_rgb) { 1, 1, 1 };
        const lmp_rgb e = lmp_light_irradiance(&area, 1, surface->position, surface->normal);
        compare(with, "an area's irradiance", (double)e.r, 3.14);
    }
    with->value += AREAS - of->areas;
}

static void compare_ggx(comparison *with, const configuration *of, const lmp_surface *surface,
                        float roughness, lmp_shade_settings settings, const lmp_light *lights,
                        int lobe_number) {
    lmp_material metal = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                           .base_color = { 0.9f, 0.6f, 0.3f },
                           .metallic = 0.7f,
                           .roughness = roughness };
    lmp_ggx_lobes lobes;
    compare_methods(with, settings, &metal, surface, lights, LIGHTS + of->areas);
    metal.coat = (lmp_coat) { .weight = 0.8f, .roughness = 0.3f };
    compare_shaded(with, "coat", &settings, &metal, surface, lights, LIGHTS + of->areas);
    lmp_lobe_find_ggx(surface->normal, surface->view, roughness, &lobes);
    const lmp_ggx_lobe *lobe = &lobes.lobe[lobe_number];
    compare_vec3(with, "a lobe's axis", lobe->axis);
    compare(with, "a lobe's exponent", (double)lobe->exponent, (double)lobe->exponent);
    compare(with, "a lobe's F0", (double)lobe->f0, 1);
    compare(with, "a lobe's F90", (double)lobe->f90, 1);
    compare(with, "the diffuse F90", (double)lobes.diffuse_f90, 1);
}

static void compare_arrays(comparison *with, const configuration *of, const world *from,
                           const lmp_surface *surface, float exponent) {
    float values[BANDS_MOST], sh[LMP_SH_COUNT(BANDS_MOST)];
    float window[BANDS_MOST];
    const int bands = of->bands;
    const lmp_light *light = &from->lights[0];
    lmp_vec3 axis;
    lmp_sh_make_window(bands, of->window, 0, window);
    lmp_lobe_make_phong(bands, exponent, values);
    for (int l = 0; l < bands; l++)
        values[l] *= window[l];
    compare_array(with, "a Phong lobe", values, (size_t)bands);
    lmp_lobe_make_diffuse(bands, values);
    compare_array(with, "the diffuse lobe", values, (size_t)bands);
    compare_array(with, "the window", window, (size_t)bands);
    lmp_light_project_zonal(bands, light, surface->position, values, &axis);
    for (int l = 0; l < bands; l++) /* L_l0 = pi R_l Y_l0(z), Y_l0(z)² = (2l+1) / (4 pi) */
        values[l] /= sqrtf((float)(2 * l + 1) * LMP_LOOKUP_PI / 4);
    compare_array(with, "a cap's series", values, (size_t)bands);
    lmp_sphere_project(bands, light->position, light->radius, surface->position, sh);
    compare_array(with, "a sphere's coefficients", sh, LMP_SH_COUNT(bands));
    lmp_sh_eval(bands, surface->normal, sh);
    compare_array(with, "the basis", sh, LMP_SH_COUNT(bands));
}

/* Compares two colors of a surface, the irradiance of a probe's three bands and of the first two.
 */
static comparison compare_probes(const given *data, const world *from, int i, const float *values) {
    comparison with = { .value = values };
    const lmp_vec3 normal = vec3_of(data->surface[i][1]);
    float two[3 * 4];
    for (int k = 0; k < 3 * 4; k++)
        two[k] = from->probe_sh[k / 4 * 9 + k % 4];
    compare_rgb(&with, "a probe", lmp_probe_irradiance(3, from->probe_sh, normal), 5);
    compare_rgb(&with, "a probe of two bands", lmp_probe_irradiance(2, two, normal), 5);
    return with;
}

/* Compares all values of a surface. */
static comparison compare_surface(const configuration *of, const given *data, const world *from,
                                  const tables *with_tables, int i, const float *values) {
    comparison with = { .value = values };
    const lmp_material clay = { .diffuse = { 0.8f, 0.4f, 0.3f },
                                .specular = { 0.04f, 0.05f, 0.06f },
                                .exponent = 30 };
    const lmp_material integrated = { .kind = LMP_MATERIAL_PREINTEGRATED,
                                      .preintegrated = with_tables->brdf };
    lmp_shade_settings settings = { .bands = of->bands,
                                    .window = of->window,
                                    .lobe = with_tables->lobe };
    const lmp_surface surface = { .position = vec3_of(data->surface[i][0]),
                                  .normal = vec3_of(data->surface[i][1]),
                                  .view = vec3_of(data->surface[i][2]) };
    const float roughness = data->surface[i][0][3];
    const lmp_coat coat = { .weight = 0.8f, .roughness = 0.3f };
    compare_methods(&with, settings, &clay, &surface, from->lights, LIGHTS + of->areas);
    settings.method = LMP_SHADE_PREINTEGRATED;
    compare_shaded(&with, "preintegrated BRDF", &settings, &integrated, &surface, from->lights,
                   LIGHTS);
    settings.method = LMP_SHADE_ZONAL;
    compare_rgb(&with, "a probe", lmp_probe_irradiance(3, from->probe_sh, surface.normal), 5);
    compare_irradiance(&with, of, from, &surface);
    compare(&with, "a coat",
            (double)lmp_material_coat_reflectance(&coat, surface.normal, surface.view), 1);
    if (of->ggx)
        compare_ggx(&with, of, &surface, roughness, settings, from->lights, i % LMP_GGX_LOBES);
    else
        with.value += 19;
    compare_arrays(&with, of, from, &surface, 200 * roughness);
    assert_int_equal(with.value - values, count_values(of));
    return with;
}

#endif
