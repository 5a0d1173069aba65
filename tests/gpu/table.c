/* SPDX-License-Identifier: MIT */
/* Materials with tables on the GPU against lmp_shade at the very same surface points. */
#include "app/render/shade.h"
#include "tests/gpu/device.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 60, HEIGHT = 80, BANDS = 10 };

static lmp_brdf_table *table_of(lmp_result made, lmp_brdf *brdf, int bands) {
    lmp_brdf_table *table = NULL;
    const lmp_brdf_table_desc desc = {
        .bands = bands, .views = 32, .azimuths = 16, .window = LMP_WINDOW_HANNING, .rings_max = 128
    };
    assert_int_equal(made, LMP_OK);
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    lmp_brdf_destroy(brdf);
    return table;
}

/* Returns the largest difference to lmp_shade, relative to the largest radiance. */
static double difference(gpu_renderer *renderer, const render_frame *frame, int *by_table) {
    static lmp_light lights[SCENE_LIGHTS_MAX];
    for (size_t i = 0; i < frame->light_count; i++)
        lights[i] = frame->lights[i].emitter;
    image drawn = render_image(renderer, frame);
    render_pixel *pixels = render_pixels(renderer, frame);
    const lmp_shade_settings settings = { .method = method_table[frame->method].method,
                                          .bands = frame->bands,
                                          .window = frame->window };
    double worst = 0, peak = 0;
    *by_table = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        const render_pixel *p = &pixels[i];
        if (p->kind != RENDER_SURFACE)
            continue;
        *by_table += p->material.kind == LMP_MATERIAL_TABLE;
        const lmp_rgb c =
            lmp_shade(&settings, &p->material, &p->surface, lights, frame->light_count);
        const float expected[3] = { c.r + p->emission.r, c.g + p->emission.g, c.b + p->emission.b };
        for (size_t k = 0; k < 3; k++) {
            const double error = fabs((double)drawn.rgb[3 * i + k] - (double)expected[k]);
            assert_true(isfinite(error));
            worst = fmax(worst, error);
            peak = fmax(peak, (double)expected[k]);
        }
    }
    image_free(&drawn);
    free(pixels);
    return worst / peak;
}

/* Checks the tables by one method. */
static void agree_by(method_kind method, lmp_brdf_table *first, lmp_brdf_table *second, int bands,
                     double bound) {
    base_error error = { "" };
    scene world;
    expect(scene_load("builtin:ball", &(scene_options) { .no_cache = true }, &world, &error),
           &error);
    gpu_renderer *renderer = open_renderer(&world);
    int uses[64];
    assert_true(world.material_count >= 2 && world.material_count < 64);
    for (size_t i = 0; i < world.material_count; i++)
        uses[i] = i == 0 ? 1 : i + 1 == world.material_count ? 0 : -1;
    const lmp_brdf_table *const tables[] = { first, second };
    expect(gpu_set_tables(renderer, tables, 2, uses, &error), &error);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = bands;
    frame.window = LMP_WINDOW_HANNING;
    frame.method = method;
    int by_table = 0;
    const double worst = difference(renderer, &frame, &by_table);
    print_message("%d pixels by table: %.1e of the peak\n", by_table, worst);
    assert_true(by_table > 100);
    if (!(worst <= bound))
        fail_msg("%g of the peak", worst);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
    lmp_brdf_table_destroy(first);
    lmp_brdf_table_destroy(second);
}

static lmp_brdf_table *phong(float exponent, int bands) {
    lmp_brdf *brdf = NULL;
    const lmp_result made =
        lmp_brdf_create_phong(NULL, (lmp_rgb) { 0.8f, 0.6f, 0.3f }, exponent, &brdf);
    return table_of(made, brdf, bands);
}

static void mirrored_tables_agree_with_lmp_shade(void **state) {
    (void)state;
    agree_by(METHOD_ZONAL, phong(20, BANDS), phong(3, BANDS), BANDS, 5e-4);
    agree_by(METHOD_COEFFICIENTS, phong(20, BANDS), phong(3, BANDS), BANDS, 5e-4);
}

static void tables_of_fewer_bands_agree_with_lmp_shade(void **state) {
    (void)state;
    agree_by(METHOD_ZONAL, phong(20, BANDS - 3), phong(3, BANDS - 3), BANDS, 5e-4);
}

static void anisotropic_agree_by(method_kind method, int bands) {
    const lmp_ggx desc = { 0.6f, 0.3f, { 0.9f, 0.8f, 0.6f }, { 0.1f, 0.1f, 0.1f } };
    lmp_brdf *brdf = NULL;
    const lmp_result made = lmp_brdf_create_ggx(NULL, &desc, &brdf);
    agree_by(method, table_of(made, brdf, bands), phong(5, bands), bands, 5e-3);
}

static void anisotropic_tables_agree_with_lmp_shade_by_zonal_sums(void **state) {
    (void)state;
    anisotropic_agree_by(METHOD_ZONAL, BANDS);
}

static void anisotropic_tables_agree_with_lmp_shade_by_coefficients(void **state) {
    (void)state;
    anisotropic_agree_by(METHOD_COEFFICIENTS, usual_bands());
}

/* A sky of 4 bands that every rotation changes. */
enum { SKY_BANDS = 4 };
static environment sky_of(float *sh) {
    for (int i = 0; i < 3 * SKY_BANDS * SKY_BANDS; i++)
        sh[i] = (float)check_random_between(-0.05, 0.05);
    for (int c = 0; c < 3; c++)
        sh[c * SKY_BANDS * SKY_BANDS] = (float)(c + 1);
    return (environment) { .light = { .width = 1, .height = 1, .rgb = sh },
                           .sh = sh,
                           .bands = SKY_BANDS };
}

/* Returns the largest difference between the devices, relative to the largest radiance. */
static double difference_between_devices(gpu_renderer *renderer, render_frame *frame) {
    frame->cpu_shader = NULL;
    image gpu = render_image(renderer, frame);
    frame->cpu_shader = shade_frame;
    image cpu = render_image(renderer, frame);
    double worst = 0, peak = 0;
    for (size_t i = 0; i < (size_t)3 * (size_t)frame->width * (size_t)frame->height; i++) {
        worst = fmax(worst, fabs((double)gpu.rgb[i] - (double)cpu.rgb[i]));
        peak = fmax(peak, (double)cpu.rgb[i]);
    }
    assert_true(peak > 0.1);
    image_free(&gpu);
    image_free(&cpu);
    return worst / peak;
}

/* Without lights, what a material shows is what it reflects of the environment. Pixels and bands
 * are few, because software drivers take long. */
static void tables_reflect_an_environment_as_the_library_has_it(void **state) {
    (void)state;
    base_error error = { "" };
    scene world;
    float sh[3 * SKY_BANDS * SKY_BANDS];
    const environment sky = sky_of(sh);
    const lmp_ggx desc = { 0.6f, 0.3f, { 0.9f, 0.8f, 0.6f }, { 0.1f, 0.1f, 0.1f } };
    lmp_brdf *brdf = NULL;
    const lmp_result made = lmp_brdf_create_ggx(NULL, &desc, &brdf);
    lmp_brdf_table *tables[2] = { phong(20, SKY_BANDS), table_of(made, brdf, SKY_BANDS) };
    expect(scene_load("builtin:ball", &(scene_options) { .no_cache = true }, &world, &error),
           &error);
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, WIDTH / 4, HEIGHT / 4);
    frame.bands = SKY_BANDS;
    frame.window = LMP_WINDOW_HANNING;
    frame.light_count = 0;
    for (int t = 0; t < 2; t++) {
        const lmp_brdf_table *const table = tables[t];
        int uses[64] = { 0 };
        expect(gpu_set_tables(renderer, &table, 1, uses, &error), &error);
        gpu_set_environment(renderer, &sky);
        const double worst = difference_between_devices(renderer, &frame);
        print_message("%.1e of the peak\n", worst);
        CHECK_WITHIN(worst, 1e-3);
        lmp_brdf_table_destroy(tables[t]);
    }
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

static void tables_of_more_bands_are_refused(void **state) {
    (void)state;
    base_error error = { "" };
    scene world;
    expect(scene_load("builtin:ball", &(scene_options) { .no_cache = true }, &world, &error),
           &error);
    gpu_renderer *renderer = open_renderer(&world);
    lmp_brdf_table *table = phong(5, BANDS);
    const lmp_brdf_table *const tables[] = { table };
    const int uses[64] = { 0 };
    expect(gpu_set_tables(renderer, tables, 1, uses, &error), &error);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = BANDS - 1;
    assert_false(gpu_render(renderer, &frame, NULL, &error));
    assert_non_null(strstr(error.text, "10 bands"));
    gpu_renderer_destroy(renderer);
    scene_free(&world);
    lmp_brdf_table_destroy(table);
}

int main(int count, char **arguments) {
    const struct CMUnitTest mirrored[] = {
        cmocka_unit_test(mirrored_tables_agree_with_lmp_shade),
        cmocka_unit_test(tables_of_fewer_bands_agree_with_lmp_shade),
    };
    const struct CMUnitTest zonal[] = {
        cmocka_unit_test(anisotropic_tables_agree_with_lmp_shade_by_zonal_sums),
    };
    const struct CMUnitTest coefficients[] = {
        cmocka_unit_test(anisotropic_tables_agree_with_lmp_shade_by_coefficients),
    };
    const struct CMUnitTest environments[] = {
        cmocka_unit_test(tables_reflect_an_environment_as_the_library_has_it),
        cmocka_unit_test(tables_of_more_bands_are_refused),
    };
    int ran = 0, failed = 0;
    RUN_GROUP(mirrored);
    RUN_GROUP_AS(zonal, "anisotropic.zonal");
    RUN_GROUP_AS(coefficients, "anisotropic.coefficients");
    RUN_GROUP(environments);
    return ran > 0 ? failed : 1;
}
