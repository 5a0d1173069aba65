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

/* Against the light's own scale of 1, for the sum of a ringing series may cancel. */
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

/* Dot products of n² coefficients by the oracle; sphere lights. */
static void shade_by_definition(int bands, const double *window, const lmp_material *material,
                                const lmp_surface *surface, const lmp_light *lights, int count,
                                double color[3]) {
    static double light[1600], y[1600];
    double diffuse[40], phong[40], n[3], v[3], mirror[3], p[3], center[3];
    const lmp_vec3 vectors[3] = { surface->normal, surface->view, surface->position };
    double *targets[3] = { n, v, p };
    for (int i = 0; i < 3; i++) {
        targets[i][0] = (double)vectors[i].x;
        targets[i][1] = (double)vectors[i].y;
        targets[i][2] = (double)vectors[i].z;
    }
    const double twice = 2 * (n[0] * v[0] + n[1] * v[1] + n[2] * v[2]);
    for (int k = 0; k < 3; k++)
        mirror[k] = twice * n[k] - v[k];
    oracle_lobe_diffuse(bands, diffuse);
    oracle_lobe_phong(bands, (double)material->exponent, phong);
    double lobes[2][3] = { { 0 } };
    for (int i = 0; i < count; i++) {
        center[0] = (double)lights[i].position.x;
        center[1] = (double)lights[i].position.y;
        center[2] = (double)lights[i].position.z;
        const double radiance[3] = { (double)lights[i].radiance.r, (double)lights[i].radiance.g,
                                     (double)lights[i].radiance.b };
        oracle_sphere(bands, center, (double)lights[i].radius, p, light, NULL);
        for (int lobe = 0; lobe < 2; lobe++) {
            double sum = 0;
            oracle_sh_eval(bands, lobe ? mirror : n, y);
            for (int l = 0, k = 0; l < bands; l++)
                for (int m = -l; m <= l; m++, k++)
                    sum += (lobe ? phong : diffuse)[l] * window[l] * light[k] * y[k];
            for (int c = 0; c < 3; c++)
                lobes[lobe][c] += radiance[c] * sum;
        }
    }
    const double albedo[3] = { (double)material->diffuse.r, (double)material->diffuse.g,
                               (double)material->diffuse.b };
    const double gloss[3] = { (double)material->specular.r, (double)material->specular.g,
                              (double)material->specular.b };
    for (int c = 0; c < 3; c++)
        color[c] = fmax(albedo[c] / ORACLE_PI * lobes[0][c] + gloss[c] * lobes[1][c], 0);
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
            shade_by_definition(counts[i], window, &material, &surface, lights, 6, expected);
            float channels[3];
            const lmp_shade_settings coefficients = by_coefficients(&settings);
            to_array(lmp_shade(&coefficients, &material, &surface, lights, 6), channels);
            CHECK_WITHIN(difference(expected, channels), 1e-5);
            to_array(lmp_shade(&settings, &material, &surface, lights, 6), channels);
            CHECK_WITHIN(difference(expected, channels), 1e-5);
        }
    }
}

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
        const lmp_material material = two_lobes((float)(trial * trial));
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
    int rung = 0;
    for (int i = 0; i < 200; i++) {
        lmp_light light;
        random_spheres(1, &light);
        const lmp_surface surface = random_surface();
        const lmp_material material = { .specular = { 1, 1, 1 }, .exponent = 200 };
        float channels[3];
        to_array(lmp_shade(NULL, &material, &surface, &light, 1), channels);
        for (int c = 0; c < 3; c++)
            assert_true(channels[c] >= 0);
        rung += channels[0] == 0;
    }
    assert_true(rung > 0); /* the clamp was needed */
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
    /* peaks of a Phong lobe of exponent 60 cut at 10 bands: 5.46, 2.29, 2.90 */
    CHECK_WITHIN(
        fabs((double)(lmp_shade(&hanning, &material, &facing, &light, 1).r / peak) - 2.29 / 5.46),
        5e-3);
    CHECK_WITHIN(
        fabs((double)(lmp_shade(&lanczos, &material, &facing, &light, 1).r / peak) - 2.90 / 5.46),
        5e-3);
}

static void metallic_roughness_becomes_two_lobes(void **state) {
    (void)state;
    const lmp_rgb base = { 0.5f, 0.25f, 1 };
    const lmp_material plastic = lmp_material_from_metallic_roughness(base, 0, 1);
    CHECK_WITHIN(fabsf(plastic.diffuse.g - 0.25f) + fabsf(plastic.specular.g - 0.04f) +
                     fabsf(plastic.exponent),
                 1e-6);
    const lmp_material metal = lmp_material_from_metallic_roughness(base, 1, 0.5f);
    CHECK_WITHIN(
        fabsf(metal.diffuse.b) + fabsf(metal.specular.r - 0.5f) + fabsf(metal.exponent - 30), 1e-5);
    const lmp_material half = lmp_material_from_metallic_roughness(base, 0.5f, 1);
    CHECK_WITHIN(fabsf(half.diffuse.r - 0.25f) + fabsf(half.specular.r - 0.27f), 1e-6);
    const lmp_material smooth = lmp_material_from_metallic_roughness(base, 7, -1);
    CHECK_WITHIN(fabsf(smooth.exponent / (2 / (LMP_ALPHA_MIN * LMP_ALPHA_MIN) - 2) - 1), 1e-6);
    assert_true(smooth.diffuse.r == 0);
}

/* A material of that kind is shaded as the lobes that stand for it, by every way to shade. */
static void metallic_roughness_is_shaded_as_its_lobes(void **state) {
    (void)state;
    const lmp_material kind = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                .base_color = { 0.5f, 0.25f, 1 },
                                .metallic = 0.3f,
                                .roughness = 0.4f };
    const lmp_material lobes =
        lmp_material_from_metallic_roughness(kind.base_color, kind.metallic, kind.roughness);
    for (int method = 0; method < 2; method++) {
        const lmp_shade_settings settings = { .method = (lmp_shade_method)method };
        const lmp_surface surface = random_surface();
        lmp_light lights[3];
        float expected[3], channels[3];
        random_spheres(3, lights);
        to_array(lmp_shade(&settings, &lobes, &surface, lights, 3), expected);
        to_array(lmp_shade(&settings, &kind, &surface, lights, 3), channels);
        assert_memory_equal(expected, channels, sizeof expected);
        const lmp_surfaces one = { .position = lmp_vec3_array_same(&surface.position),
                                   .normal = lmp_vec3_array_same(&surface.normal),
                                   .view = lmp_vec3_array_same(&surface.view),
                                   .material = &kind };
        lmp_shade_n(&settings, &one, 1, lights, 3, 0, channels);
        for (int c = 0; c < 3; c++)
            CHECK_WITHIN(fabsf(channels[c] - expected[c]), 1e-4f * fmaxf(expected[c], 1));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_methods_agree_with_the_definition),
        cmocka_unit_test(both_methods_agree_for_every_kind_of_light),
        cmocka_unit_test(defaults_are_ten_bands_and_no_window),
        cmocka_unit_test(never_goes_below_zero),
        cmocka_unit_test(a_white_surface_in_uniform_light_returns_it),
        cmocka_unit_test(windows_dim_the_highlight_and_calm_the_ringing),
        cmocka_unit_test(metallic_roughness_becomes_two_lobes),
        cmocka_unit_test(metallic_roughness_is_shaded_as_its_lobes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
