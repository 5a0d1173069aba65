/* SPDX-License-Identifier: MIT */
/* Light that bounces in the ground truth, in closed rooms where what every bounce adds is known. */
#include "app/truth/reference.h"
#include "tests/reference/cube.h"

#include <math.h>

static void draw(room *r, int bounces, image *radiance, image *standard_error) {
    base_error error = { "" };
    r->settings.bounces = bounces;
    if (!reference_render(&r->world, &r->settings, radiance, standard_error, &error))
        fail_msg("%s", error.text);
}

/* Checks that every pixel is `expected` within its noise, of which the mean has little. */
static void check_pixels(room *r, int bounces, double expected) {
    image radiance, standard_error;
    double mean = 0, variance = 0;
    draw(r, bounces, &radiance, &standard_error);
    for (int i = 0; i < 3 * PIXELS; i++) {
        const double noise = (double)standard_error.rgb[i];
        CHECK_WITHIN(fabs((double)radiance.rgb[i] - expected), 6 * noise + 1e-5 * expected);
        mean += (double)radiance.rgb[i] / (3 * PIXELS);
        variance += noise * noise / PIXELS / PIXELS / 3;
    }
    CHECK_WITHIN(fabs(mean - expected), 4 * sqrt(variance) + 1e-5 * expected);
    image_free(&radiance);
    image_free(&standard_error);
}

static const int numbers[] = { 0, 1, 2, 8 };

/* Walls that emit 1 and reflect rho have 1 + rho + rho² + … : what they emit, the light of the
 * others, and that of each bounce. */
static void a_furnace_holds_the_geometric_series(void **state) {
    (void)state;
    const double albedos[] = { 0.5, 0.8 };
    for (int k = 0; k < 2; k++) {
        room r;
        open_room(cube_obj, "Ke 1 1 1\n", albedos[k], &r);
        for (int i = 0; i < 4; i++)
            check_pixels(&r, numbers[i], (1 - pow(albedos[k], numbers[i] + 2)) / (1 - albedos[k]));
        close_room(&r);
    }
}

/* A lamp in the middle of a cube: what a wall receives on average is the power divided by the area
 * of the walls, and each bounce adds as much of it as is reflected. */
static void the_power_of_a_lamp_is_kept(void **state) {
    (void)state;
    const double albedo = 0.6, radius = 0.2;
    room r;
    open_room(cube_obj, "", albedo, &r);
    const scene_light lamp = { .emitter = { .radius = (float)radius, .radiance = { 2, 2, 2 } },
                               .hidden = 1 };
    light_by(&r, &lamp);
    r.settings.camera = (scene_camera) {
        .eye = { 0, 0, 0.5f }, .target = { 0, 0, -1 }, .up = { 0, 1, 0 }, .height = 2
    };
    r.settings.rays = 16;
    r.settings.samples = 64;
    const double power = 4 * M_PI * M_PI * radius * radius * 2, area = 24;
    for (int i = 0; i < 4; i++) {
        image radiance, standard_error;
        double mean = 0, variance = 0;
        draw(&r, numbers[i], &radiance, &standard_error);
        for (int k = 0; k < PIXELS; k++) {
            const double noise = (double)standard_error.rgb[3 * k + 1];
            mean += (double)radiance.rgb[3 * k + 1] / PIXELS;
            variance += noise * noise / PIXELS / PIXELS;
        }
        const double expected =
            power / area * albedo / M_PI * (1 - pow(albedo, numbers[i] + 1)) / (1 - albedo);
        print_message("%d bounces: %.5f ± %.5f, expected %.5f\n", numbers[i], mean, sqrt(variance),
                      expected);
        CHECK_WITHIN(fabs(mean - expected), 4 * sqrt(variance) + 1e-3 * expected);
        CHECK_WITHIN(sqrt(variance), 0.01 * expected);
        image_free(&radiance);
        image_free(&standard_error);
    }
    close_room(&r);
}

/* Sums the green of the pixels and their variance. */
static double sum_of(room *r, int bounces, double *variance) {
    image radiance, standard_error;
    double sum = 0;
    draw(r, bounces, &radiance, &standard_error);
    *variance = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double noise = (double)standard_error.rgb[3 * i + 1];
        sum += (double)radiance.rgb[3 * i + 1];
        *variance += noise * noise;
    }
    image_free(&radiance);
    image_free(&standard_error);
    return sum;
}

/* Light of radiance 1 from everywhere comes back from diffuse walls as rho of it, and whatever the
 * floor reflects of the one it reflects of the other. */
static void any_material_reflects_light_that_bounced(void **state) {
    (void)state;
    const double albedo = 0.7;
    room r;
    open_room(cube_obj, "", albedo, &r);
    light_evenly(&r);
    r.settings.camera = (scene_camera) {
        .eye = { 0, 0, 0.5f }, .target = { 0, -1, 0 }, .up = { 0, 1, 0 }, .fov = 0.3f
    };
    r.settings.samples = 4096;
    for (size_t i = 0; i < r.world.material_count; i++)
        if (strcmp(r.materials[i].name, "floor") == 0) {
            r.materials[i].metallic = 0.5f;
            r.materials[i].roughness = 0.4f;
            r.materials[i].f90 = 1;
            r.materials[i].f0[1] = 0.04f;
        }
    double of_direct, of_bounced;
    const double direct = sum_of(&r, 0, &of_direct), bounced = sum_of(&r, 1, &of_bounced);
    print_message("%.4f and %.4f\n", direct / PIXELS, bounced / PIXELS);
    CHECK_WITHIN(fabs(bounced - (1 + albedo) * direct),
                 4 * sqrt(of_bounced + pow(1 + albedo, 2) * of_direct));
    CHECK_WITHIN(sqrt(of_bounced), 0.003 * bounced);
    close_room(&r);
}

/* Light reaches the ceiling without shadows, but the floor sees its back. */
static void backs_of_single_sided_triangles_reflect_nothing(void **state) {
    (void)state;
    room r;
    double variance;
    open_room(sheets_obj, "", 0.5, &r);
    light_evenly(&r);
    r.settings.camera = (scene_camera) {
        .eye = { 0, 0, 0.5f }, .target = { 0, -1, 0 }, .up = { 0, 1, 0 }, .fov = 0.3f
    };
    const double direct = sum_of(&r, 0, &variance);
    CHECK_WITHIN(fabs(sum_of(&r, 3, &variance) / direct - 1), 1e-6);
    for (size_t i = 0; i < r.world.material_count; i++)
        r.materials[i].flags = SCENE_DOUBLE_SIDED;
    assert_true(sum_of(&r, 3, &variance) > 1.5 * direct);
    close_room(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_furnace_holds_the_geometric_series),
        cmocka_unit_test(the_power_of_a_lamp_is_kept),
        cmocka_unit_test(any_material_reflects_light_that_bounced),
        cmocka_unit_test(backs_of_single_sided_triangles_reflect_nothing),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
