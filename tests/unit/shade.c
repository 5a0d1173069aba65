/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/shade.h>

#include <math.h>
#include <string.h>

static lmp_surface random_surface(void) {
    return (lmp_surface) { .position = { (float)check_random(), (float)check_random(),
                                         (float)check_random() },
                           .normal = check_random_direction(),
                           .view = check_random_direction() };
}

static lmp_rgb random_color(void) {
    return (lmp_rgb) { (float)check_random(), (float)check_random(), (float)check_random() };
}

static lmp_material two_lobes(float exponent) {
    return (lmp_material) { .diffuse = random_color(),
                            .specular = random_color(),
                            .exponent = exponent };
}

static lmp_shade_settings by_coefficients(const lmp_shade_settings *settings) {
    lmp_shade_settings by = settings ? *settings : (lmp_shade_settings) { 0 };
    by.method = LMP_SHADE_COEFFICIENTS;
    return by;
}

static void random_spheres(int count, lmp_light *lights) {
    for (int i = 0; i < count; i++)
        lights[i] = (lmp_light) { .position = { (float)check_random_between(-3, 3),
                                                (float)check_random_between(-3, 3),
                                                (float)check_random_between(-3, 3) },
                                  .radius = (float)check_random(),
                                  .radiance = random_color() };
}

/* Returns the difference relative to the light's own scale of 1, because the sum of a ringing
 * series may cancel. */
static double difference(const double *expected, const float *channels) {
    double largest = 0;
    for (int c = 0; c < 3; c++)
        largest = fmax(largest, fabs((double)channels[c] - expected[c]) / fmax(expected[c], 1));
    return largest;
}

static void to_array(lmp_rgb color, float *channels) {
    channels[0] = color.r, channels[1] = color.g, channels[2] = color.b;
}

/* --- the definition, in double ---------------------------------------------------------------- */

/* A lobe: weight times the kernel max(axis·w, 0), or that of a Phong lobe of integral 1. */
typedef struct defined_lobe {
    bool diffuse;
    double axis[3], exponent, weight[3];
} defined_lobe;

enum { DEFINED_LOBES = 1 + LMP_GGX_LOBES };

static void widen(const float *from, double to[3]) {
    for (int k = 0; k < 3; k++)
        to[k] = (double)from[k];
}

static int define_phong(const lmp_material *material, const double n[3], const double v[3],
                        defined_lobe *lobes) {
    const double twice = 2 * (n[0] * v[0] + n[1] * v[1] + n[2] * v[2]);
    widen(&material->diffuse.r, lobes[0].weight);
    widen(&material->specular.r, lobes[1].weight);
    lobes[1].exponent = (double)material->exponent;
    for (int k = 0; k < 3; k++)
        lobes[1].axis[k] = twice * n[k] - v[k];
    return 2;
}

static int define_ggx(const lmp_material *material, const lmp_surface *surface,
                      defined_lobe *lobes) {
    lmp_ggx_lobes ggx;
    double base[3], f0[3] = { 0.04, 0.04, 0.04 }, f90 = 1;
    const double metal = fmin(fmax((double)material->metallic, 0), 1);
    if (material->dielectric.given) {
        widen(&material->dielectric.f0.r, f0);
        f90 = (double)material->dielectric.f90;
    }
    lmp_lobe_find_ggx(surface->normal, surface->view, material->roughness, &ggx);
    widen(&material->base_color.r, base);
    const double passed = 1 - fmax(f0[0], fmax(f0[1], f0[2])) * (double)ggx.diffuse_f0 -
                          f90 * (double)ggx.diffuse_f90;
    for (int c = 0; c < 3; c++)
        lobes[0].weight[c] = base[c] * (1 - metal) * passed;
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        const lmp_ggx_lobe *from = &ggx.lobe[k];
        lobes[1 + k].exponent = (double)from->exponent;
        widen(&from->axis.x, lobes[1 + k].axis);
        for (int c = 0; c < 3; c++)
            lobes[1 + k].weight[c] = (double)from->f0 * (f0[c] + (base[c] - f0[c]) * metal) +
                                     (double)from->f90 * (f90 + (1 - f90) * metal);
    }
    return DEFINED_LOBES;
}

/* Defines the lobes of a material by lampion/shade.h; returns how many there are. */
static int define_lobes(const lmp_material *material, const lmp_surface *surface,
                        defined_lobe lobes[DEFINED_LOBES]) {
    double n[3], v[3];
    memset(lobes, 0, DEFINED_LOBES * sizeof *lobes);
    widen(&surface->normal.x, n);
    widen(&surface->view.x, v);
    const int count = material->kind == LMP_MATERIAL_METALLIC_ROUGHNESS
                          ? define_ggx(material, surface, lobes)
                          : define_phong(material, n, v, lobes);
    lobes[0].diffuse = true;
    for (int k = 0; k < 3; k++) {
        lobes[0].axis[k] = n[k];
        lobes[0].weight[k] /= ORACLE_PI;
    }
    return count;
}

/* Returns what a lobe reflects, given coefficients: a dot product of n². */
static double reflect_by_definition(int bands, const double *window, const defined_lobe *lobe,
                                    const double *light) {
    static double y[1600];
    double lambda[40], sum = 0;
    if (lobe->diffuse)
        oracle_lobe_diffuse(bands, lambda);
    else
        oracle_lobe_phong(bands, lobe->exponent, lambda);
    oracle_sh_eval(bands, lobe->axis, y);
    for (int l = 0, i = 0; l < bands; l++)
        for (int m = -l; m <= l; m++, i++)
            sum += lambda[l] * window[l] * light[i] * y[i];
    return sum;
}

/* Returns the irradiance on a surface that faces `normal`, of a sphere of radiance 1. */
static double irradiance_by_definition(const double center[3], double radius, const double point[3],
                                       const double normal[3]) {
    double along = 0, d2 = 0;
    for (int k = 0; k < 3; k++) {
        along += (center[k] - point[k]) * normal[k];
        d2 += (center[k] - point[k]) * (center[k] - point[k]);
    }
    const double d = sqrt(d2), sine = d < radius ? d / radius : radius / d;
    const double cosine = sqrt(1 - sine * sine);
    return oracle_irradiance(along / d, d < radius ? 1 + cosine : sine * sine / (1 + cosine));
}

/* Shades under sphere lights by the oracle: Phong lobes truncated and windowed, and the diffuse
 * lobe, too, with coefficients, otherwise exact. */
static void shade_by_definition(lmp_shade_method method, int bands, const double *window,
                                const lmp_material *material, const lmp_surface *surface,
                                const lmp_light *lights, int count, double color[3]) {
    static double light[1600];
    defined_lobe lobes[DEFINED_LOBES];
    const int lobe_count = define_lobes(material, surface, lobes);
    double point[3], center[3], radiance[3], sum[3] = { 0, 0, 0 };
    widen(&surface->position.x, point);
    for (int i = 0; i < count; i++) {
        widen(&lights[i].position.x, center);
        widen(&lights[i].radiance.r, radiance);
        oracle_sphere(bands, center, (double)lights[i].radius, point, light, NULL);
        for (int k = 0; k < lobe_count; k++) {
            const double reflected =
                lobes[k].diffuse && method != LMP_SHADE_COEFFICIENTS
                    ? irradiance_by_definition(center, (double)lights[i].radius, point,
                                               lobes[k].axis)
                    : reflect_by_definition(bands, window, &lobes[k], light);
            for (int c = 0; c < 3; c++)
                sum[c] += lobes[k].weight[c] * radiance[c] * reflected;
        }
    }
    for (int c = 0; c < 3; c++)
        color[c] = fmax(sum[c], 0);
}

static void both_methods_agree_with_the_definition(void **state) {
    (void)state;
    const int counts[] = { 1, 3, 10, 40 };
    const float exponents[] = { 0, 1, 30.5f, 400 };
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            lmp_light lights[6];
            random_spheres(6, lights);
            const lmp_surface surface = random_surface();
            const lmp_material material = two_lobes(exponents[j]);
            const lmp_shade_settings settings = { .bands = counts[i],
                                                  .window = j % 2 ? LMP_WINDOW_HANNING
                                                                  : LMP_WINDOW_NONE };
            double window[40], expected[3];
            for (int l = 0; l < counts[i]; l++)
                window[l] = j % 2 ? (1 + cos(ORACLE_PI * l / counts[i])) / 2 : 1;
            float channels[3];
            const lmp_shade_settings coefficients = by_coefficients(&settings);
            shade_by_definition(LMP_SHADE_COEFFICIENTS, counts[i], window, &material, &surface,
                                lights, 6, expected);
            to_array(lmp_shade(&coefficients, &material, &surface, lights, 6), channels);
            CHECK_WITHIN(difference(expected, channels), 1e-5);
            shade_by_definition(LMP_SHADE_ZONAL, counts[i], window, &material, &surface, lights, 6,
                                expected);
            to_array(lmp_shade(&settings, &material, &surface, lights, 6), channels);
            CHECK_WITHIN(difference(expected, channels), 1e-5);
        }
    }
}

/* Coefficients alone truncate the diffuse lobe (unit.irradiance). */
static void both_methods_agree_for_every_kind_of_light(void **state) {
    (void)state;
    for (int trial = 0; trial < 30; trial++) {
        lmp_light lights[6];
        random_spheres(6, lights);
        for (int i = 0; i < 6; i++) {
            lights[i].kind = (lmp_light_kind)i;
            lights[i].direction = check_random_direction();
            lights[i].angle = (float)check_random_between(0, 3.14);
            lights[i].inner = 0.5f;
            lights[i].outer = 2;
            lights[i].ground = random_color();
        }
        const lmp_surface surface = random_surface();
        lmp_material material = two_lobes((float)(trial * trial));
        material.diffuse = (lmp_rgb) { 0, 0, 0 };
        float zonal[3], coefficients[3];
        double expected[3];
        const lmp_shade_settings settings = by_coefficients(NULL);
        to_array(lmp_shade(NULL, &material, &surface, lights, 6), zonal);
        to_array(lmp_shade(&settings, &material, &surface, lights, 6), coefficients);
        for (int c = 0; c < 3; c++)
            expected[c] = (double)zonal[c];
        CHECK_WITHIN(difference(expected, coefficients), 1e-5);
    }
}

static void defaults_are_ten_bands_and_no_window(void **state) {
    (void)state;
    lmp_light light;
    random_spheres(1, &light);
    const lmp_surface surface = random_surface();
    const lmp_material material = two_lobes(50);
    const lmp_shade_settings ten = { .bands = 10 }, zero = { 0 };
    float expected[3], channels[3];
    to_array(lmp_shade(&ten, &material, &surface, &light, 1), expected);
    to_array(lmp_shade(NULL, &material, &surface, &light, 1), channels);
    assert_memory_equal(expected, channels, sizeof expected);
    to_array(lmp_shade(&zero, &material, &surface, &light, 1), channels);
    assert_memory_equal(expected, channels, sizeof expected);
}

static void never_goes_below_zero(void **state) {
    (void)state;
    int ringing = 0;
    for (int i = 0; i < 200; i++) {
        lmp_light light;
        random_spheres(1, &light);
        const lmp_surface surface = random_surface();
        const lmp_material material = { .specular = { 1, 1, 1 }, .exponent = 200 };
        float channels[3];
        to_array(lmp_shade(NULL, &material, &surface, &light, 1), channels);
        for (int c = 0; c < 3; c++)
            assert_true(channels[c] >= 0);
        ringing += channels[0] == 0;
    }
    assert_true(ringing > 0); /* the clamp was needed */
}

static void a_white_surface_in_uniform_light_returns_it(void **state) {
    (void)state;
    const lmp_light sky = { .kind = LMP_LIGHT_HEMISPHERE,
                            .direction = { 0, 1, 0 },
                            .radiance = { 0.5f, 1, 2 },
                            .ground = { 0.5f, 1, 2 } };
    const lmp_surface surface = random_surface();
    const lmp_material matte = { .diffuse = { 1, 1, 1 } },
                       glossy = { .specular = { 1, 1, 1 }, .exponent = 100 };
    const double expected[3] = { 0.5, 1, 2 };
    float channels[3];
    to_array(lmp_shade(NULL, &matte, &surface, &sky, 1), channels);
    CHECK_WITHIN(check_error(3, expected, channels), 1e-6);
    to_array(lmp_shade(NULL, &glossy, &surface, &sky, 1), channels);
    CHECK_WITHIN(check_error(3, expected, channels), 1e-6);
    to_array(lmp_shade(NULL, &matte, &surface, NULL, 0), channels);
    for (int c = 0; c < 3; c++)
        assert_true(channels[c] == 0);
}

static void windows_dim_the_highlight_and_calm_the_ringing(void **state) {
    (void)state;
    const lmp_light light = { .position = { 0, 0, 10 }, .radius = 0.5f, .radiance = { 1, 1, 1 } };
    const lmp_material material = { .specular = { 1, 1, 1 }, .exponent = 60 };
    const lmp_surface facing = { .normal = { 0, 0, 1 }, .view = { 0, 0, 1 } };
    const lmp_shade_settings none = { .bands = 10 },
                             hanning = { .bands = 10, .window = LMP_WINDOW_HANNING },
                             lanczos = { .bands = 10, .window = LMP_WINDOW_LANCZOS };
    const float peak = lmp_shade(&none, &material, &facing, &light, 1).r;
    /* peaks of a Phong lobe of exponent 60 truncated to 10 bands: 5.46, 2.29, 2.90 */
    CHECK_WITHIN(
        fabs((double)(lmp_shade(&hanning, &material, &facing, &light, 1).r / peak) - 2.29 / 5.46),
        5e-3);
    CHECK_WITHIN(
        fabs((double)(lmp_shade(&lanczos, &material, &facing, &light, 1).r / peak) - 2.90 / 5.46),
        5e-3);
}

/* Returns a random material, half of them with a dielectric of their own. */
static lmp_material random_metallic_roughness(void) {
    lmp_material material = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                              .base_color = random_color(),
                              .metallic = (float)check_random_between(-0.2, 1.2),
                              .roughness = (float)check_random_between(-0.2, 1.2) };
    if (check_random() < 0.5)
        material.dielectric = lmp_material_dielectric((float)check_random_between(1, 3),
                                                      (float)check_random(), random_color());
    return material;
}

static void metallic_roughness_is_shaded_by_the_lobes_of_ggx(void **state) {
    (void)state;
    double window[40], expected[3];
    for (int l = 0; l < 40; l++)
        window[l] = 1;
    for (int trial = 0; trial < 40; trial++) {
        const lmp_material material = random_metallic_roughness();
        const lmp_surface surface = random_surface();
        const lmp_surfaces one = { .position = lmp_vec3_array_same(&surface.position),
                                   .normal = lmp_vec3_array_same(&surface.normal),
                                   .view = lmp_vec3_array_same(&surface.view),
                                   .material = &material };
        lmp_shade_settings settings = { .bands = trial % 2 ? 10 : 3 };
        lmp_light lights[3];
        float channels[3];
        random_spheres(3, lights);
        for (int method = LMP_SHADE_ZONAL; method <= LMP_SHADE_COEFFICIENTS; method++) {
            settings.method = (lmp_shade_method)method;
            shade_by_definition(settings.method, settings.bands, window, &material, &surface,
                                lights, 3, expected);
            to_array(lmp_shade(&settings, &material, &surface, lights, 3), channels);
            CHECK_WITHIN(difference(expected, channels), 2e-5);
            lmp_shade_n(&settings, &one, 1, lights, 3, (lmp_rgb_array) { channels, 0 });
            CHECK_WITHIN(difference(expected, channels), 1e-4);
        }
    }
}

/* Fresnel's law in Schlick's form, under a uniform sky. */
static void a_smooth_metal_reflects_by_fresnels_law(void **state) {
    (void)state;
    const lmp_light sky = { .kind = LMP_LIGHT_HEMISPHERE,
                            .direction = { 0, 1, 0 },
                            .radiance = { 1, 1, 1 },
                            .ground = { 1, 1, 1 } };
    const lmp_material metal = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                 .base_color = { 0.5f, 0.25f, 1 },
                                 .metallic = 1 };
    for (int i = 1; i <= 10; i++) {
        const float z = (float)i / 10;
        const lmp_surface surface = { .normal = { 0, 0, 1 }, .view = { sqrtf(1 - z * z), 0, z } };
        double expected[3];
        float channels[3];
        widen(&metal.base_color.r, expected);
        for (int c = 0; c < 3; c++)
            expected[c] += (1 - expected[c]) * pow(1 - (double)z, 5);
        to_array(lmp_shade(NULL, &metal, &surface, &sky, 1), channels);
        CHECK_WITHIN(difference(expected, channels), 0.02);
    }
}

/* The sky is uniform and the base black: only the layer's Fresnel term remains. */
static void a_smooth_dielectric_reflects_by_its_f0_and_f90(void **state) {
    (void)state;
    const lmp_light sky = { .kind = LMP_LIGHT_HEMISPHERE,
                            .direction = { 0, 1, 0 },
                            .radiance = { 1, 1, 1 },
                            .ground = { 1, 1, 1 } };
    lmp_material glass = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS };
    glass.dielectric = lmp_material_dielectric(2.5f, 0.5f, (lmp_rgb) { 1, 0.5f, 8 });
    const double f0[3] = { 0.5 * 9 / 49, 0.25 * 9 / 49, 0.5 };
    for (int i = 1; i <= 10; i++) {
        const float z = (float)i / 10;
        const lmp_surface surface = { .normal = { 0, 0, 1 }, .view = { sqrtf(1 - z * z), 0, z } };
        double expected[3];
        float channels[3];
        for (int c = 0; c < 3; c++)
            expected[c] = f0[c] + (0.5 - f0[c]) * pow(1 - (double)z, 5);
        to_array(lmp_shade(NULL, &glass, &surface, &sky, 1), channels);
        CHECK_WITHIN(difference(expected, channels), 0.02);
    }
}

static void an_index_of_refraction_is_fresnels(void **state) {
    (void)state;
    const lmp_rgb white = { 1, 1, 1 };
    const lmp_dielectric common = lmp_material_dielectric(1.5f, 1, white);
    CHECK_WITHIN(fabs((double)common.f0.g - 0.04), 1e-8);
    assert_true(common.given && common.f90 == 1);
    assert_true(lmp_material_dielectric(1, 1, white).f0.r == 0);
    assert_true(lmp_material_dielectric(0, 1, white).f0.r == 1); /* KHR_materials_ior's mirror */
    const lmp_dielectric none = lmp_material_dielectric(2, 0, white);
    assert_true(none.given && none.f0.b == 0 && none.f90 == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_smooth_dielectric_reflects_by_its_f0_and_f90),
        cmocka_unit_test(an_index_of_refraction_is_fresnels),
        cmocka_unit_test(both_methods_agree_with_the_definition),
        cmocka_unit_test(both_methods_agree_for_every_kind_of_light),
        cmocka_unit_test(defaults_are_ten_bands_and_no_window),
        cmocka_unit_test(never_goes_below_zero),
        cmocka_unit_test(a_white_surface_in_uniform_light_returns_it),
        cmocka_unit_test(windows_dim_the_highlight_and_calm_the_ringing),
        cmocka_unit_test(metallic_roughness_is_shaded_by_the_lobes_of_ggx),
        cmocka_unit_test(a_smooth_metal_reflects_by_fresnels_law),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
