/* SPDX-License-Identifier: MIT */
/* Materials with tables on the GPU against lmp_shade at the very same surface points. */
#include "tests/gpu/device.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 60, HEIGHT = 80, BANDS = 10 };

static lmp_brdf_table *table_of(lmp_result made, lmp_brdf *brdf) {
    lmp_brdf_table *table = NULL;
    const lmp_brdf_table_desc desc = {
        .bands = BANDS, .views = 32, .azimuths = 16, .window = LMP_WINDOW_HANNING, .rings_max = 128
    };
    assert_int_equal(made, LMP_OK);
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    lmp_brdf_destroy(brdf);
    return table;
}

/* The largest difference to lmp_shade, as a part of the largest radiance. */
static double difference(gpu_renderer *renderer, const gpu_frame *frame, int *by_table) {
    static lmp_light lights[SCENE_LIGHTS_MAX];
    for (size_t i = 0; i < frame->light_count; i++)
        lights[i] = frame->lights[i].emitter;
    image drawn = render_image(renderer, frame);
    gpu_pixel *pixels = render_pixels(renderer, frame);
    const lmp_shade_settings settings = { .bands = frame->bands, .window = frame->window };
    double worst = 0, peak = 0;
    *by_table = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        const gpu_pixel *p = &pixels[i];
        if (p->kind != GPU_KIND_SURFACE)
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

static void agree_with(lmp_brdf_table *first, lmp_brdf_table *second, double bound) {
    cli_error error = { "" };
    scene world;
    expect(scene_load("builtin:ball", &(scene_options) { .no_cache = true }, &world, &error),
           &error);
    gpu_renderer *renderer = open_renderer(&world);
    int uses[64];
    assert_true(world.material_count >= 2 && world.material_count < 64);
    for (size_t i = 0; i < world.material_count; i++)
        uses[i] = i == 0 ? 1 : i + 1 == world.material_count ? 0 : -1;
    const lmp_brdf_table *const tables[] = { first, second };
    expect(gpu_set_tables(renderer, tables, 2, uses, world.material_count, &error), &error);
    gpu_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = BANDS;
    frame.window = LMP_WINDOW_HANNING;
    for (int m = 0; m < 2; m++) {
        int by_table = 0;
        frame.method = m == 0 ? METHOD_ZONAL : METHOD_COEFFICIENTS;
        const double worst = difference(renderer, &frame, &by_table);
        print_message("%d pixels by table: %.1e of the peak\n", by_table, worst);
        assert_true(by_table > 100);
        if (!(worst <= bound))
            fail_msg("%g of the peak", worst);
    }
    gpu_renderer_destroy(renderer);
    scene_free(&world);
    lmp_brdf_table_destroy(first);
    lmp_brdf_table_destroy(second);
}

static lmp_brdf_table *phong(float exponent) {
    lmp_brdf *brdf = NULL;
    const lmp_result made =
        lmp_brdf_create_phong(NULL, (lmp_rgb) { 0.8f, 0.6f, 0.3f }, exponent, &brdf);
    return table_of(made, brdf);
}

static void mirrored_tables_agree_with_lmp_shade(void **state) {
    (void)state;
    agree_with(phong(20), phong(3), 5e-4);
}

static void anisotropic_tables_agree_with_lmp_shade(void **state) {
    (void)state;
    const lmp_ggx desc = { 0.6f, 0.3f, { 0.9f, 0.8f, 0.6f }, { 0.1f, 0.1f, 0.1f } };
    lmp_brdf *brdf = NULL;
    const lmp_result made = lmp_brdf_create_ggx(NULL, &desc, &brdf);
    agree_with(table_of(made, brdf), phong(5), 5e-3);
}

static void tables_of_other_bands_are_refused(void **state) {
    (void)state;
    cli_error error = { "" };
    scene world;
    expect(scene_load("builtin:ball", &(scene_options) { .no_cache = true }, &world, &error),
           &error);
    gpu_renderer *renderer = open_renderer(&world);
    lmp_brdf_table *table = phong(5);
    const lmp_brdf_table *const tables[] = { table };
    const int uses[64] = { 0 };
    expect(gpu_set_tables(renderer, tables, 1, uses, world.material_count, &error), &error);
    gpu_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = BANDS + 1;
    assert_false(gpu_render(renderer, &frame, NULL, &error));
    assert_non_null(strstr(error.text, "10 bands"));
    gpu_renderer_destroy(renderer);
    scene_free(&world);
    lmp_brdf_table_destroy(table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirrored_tables_agree_with_lmp_shade),
        cmocka_unit_test(anisotropic_tables_agree_with_lmp_shade),
        cmocka_unit_test(tables_of_other_bands_are_refused),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
