/* SPDX-License-Identifier: MIT */
/* Light that bounces in images, by the library's transfer, in closed rooms where what every bounce
 * adds is known. */
#include "app/render/renderer/bounces.h"
#include "app/render/renderer/shadows.h"
#include "app/study/volume.h"
#include "tests/reference/cube.h"

#include <math.h>
#include <stdlib.h>

/* Draws the room by the CPU, or what its exposure is found by. */
static void draw_or_meter(const room *r, int bounces, bool shadows, bool meter, image *pixels) {
    const shadow_settings rays = { .rays = 64, .raw = true };
    base_error error = { "" };
    render_device device;
    render_frame frame = { .width = SIDE,
                           .height = SIDE,
                           .camera = r->settings.camera,
                           .method = METHOD_ZONAL,
                           .bands = 4,
                           .lights = r->world.lights,
                           .light_count = r->world.light_count };
    shadow *caster = NULL;
    assert_true(render_device_open(DEVICE_CPU, NULL, &r->world, &device, &error));
    any_renderer *renderer = renderer_create(&device, &error);
    assert_non_null(renderer);
    if (shadows) {
        caster = render_device_shadow(&device, NULL, &rays, &error);
        assert_non_null(caster);
        frame.shadow = shadow_pass(caster);
    }
    const transfer_settings settings = { .bounces = bounces, .shadows = shadows };
    const override_set none = { .count = 0 };
    transfer *bounced = render_device_transfer(&device, &none, &settings, &error);
    assert_non_null(bounced);
    frame.bounces = transfer_bounces(bounced);
    if (meter)
        assert_true(renderer_meter(renderer, &frame, pixels, &error));
    else
        assert_true(renderer_draw(renderer, &frame, NULL, &error) &&
                    renderer_read_image(renderer, pixels, &error));
    transfer_destroy(bounced);
    shadow_destroy(caster);
    renderer_destroy(renderer);
    render_device_close(&device);
}

static void draw(const room *r, int bounces, bool shadows, image *pixels) {
    draw_or_meter(r, bounces, shadows, false, pixels);
}

static double mean_of(const image *pixels) {
    double mean = 0;
    for (int i = 0; i < PIXELS; i++)
        mean += (double)pixels->rgb[3 * i + 1] / PIXELS;
    return mean;
}

static double series_of(double rho, int bounces) {
    return rho * (1 - pow(rho, bounces + 1)) / (1 - rho);
}

/* Under light of radiance 1 from everywhere, walls of albedo rho show rho + rho² + …, whatever the
 * rays have found: a term more for each bounce. */
static void even_light_keeps_the_geometric_series(void **state) {
    (void)state;
    const double albedos[] = { 0.5, 0.8 };
    const int numbers[] = { 1, 8 };
    for (int k = 0; k < 2; k++) {
        room r;
        image pixels;
        const double rho = albedos[k];
        const double expected = series_of(rho, numbers[k]);
        open_room(cube_obj, "", rho, &r);
        light_evenly(&r);
        draw(&r, numbers[k], false, &pixels);
        for (int p = 0; p < 3 * PIXELS; p++)
            CHECK_WITHIN(fabs((double)pixels.rgb[p] / expected - 1), 1e-4);
        image_free(&pixels);
        close_room(&r);
    }
}

/* What the exposure is found by has the light after bounces, too. */
static void the_exposure_sees_bounces(void **state) {
    (void)state;
    room r;
    image pixels;
    open_room(cube_obj, "", 0.8, &r);
    light_evenly(&r);
    draw_or_meter(&r, 8, false, true, &pixels);
    for (int p = 0; p < 3 * PIXELS; p++)
        CHECK_WITHIN(fabs((double)pixels.rgb[p] / series_of(0.8, 8) - 1), 1e-4);
    image_free(&pixels);
    close_room(&r);
}

/* Two pilasters on a wall leave a gap narrower than surfels are apart. They have no backs, so the
 * wall behind them sees their insides and is dark: the gap must not read it. */
static void what_stands_on_a_wall_hides_it(void **state) {
    (void)state;
    static const char pilasters[] =
        "usemtl wall\n"
        "v -0.5 -1 -0.7\nv -0.002 -1 -0.7\nv -0.002 1 -0.7\nv -0.5 1 -0.7\n"
        "v -0.002 -1 -0.7\nv -0.002 -1 -1\nv -0.002 1 -1\nv -0.002 1 -0.7\n"
        "v 0.002 -1 -0.7\nv 0.5 -1 -0.7\nv 0.5 1 -0.7\nv 0.002 1 -0.7\n"
        "v 0.002 -1 -1\nv 0.002 -1 -0.7\nv 0.002 1 -0.7\nv 0.002 1 -1\n"
        "v -0.5 -1 -1\nv -0.5 -1 -0.7\nv -0.5 1 -0.7\nv -0.5 1 -1\n"
        "v 0.5 -1 -0.7\nv 0.5 -1 -1\nv 0.5 1 -1\nv 0.5 1 -0.7\n"
        "f 25 26 27 28\nf 29 30 31 32\nf 33 34 35 36\nf 37 38 39 40\nf 41 42 43 44\n"
        "f 45 46 47 48\n";
    char obj[sizeof cube_obj + sizeof pilasters];
    room r;
    image pixels;
    snprintf(obj, sizeof obj, "%s%s", cube_obj, pilasters);
    open_room(obj, "", 0.8, &r);
    light_evenly(&r);
    r.settings.camera = (scene_camera) {
        .eye = { 0, 0, 0.5f }, .target = { 0, 0, -1 }, .up = { 0, 1, 0 }, .height = 0.003f
    };
    draw(&r, 8, false, &pixels);
    for (int p = 0; p < 3 * PIXELS; p++)
        CHECK_WITHIN(fabs((double)pixels.rgb[p] / series_of(0.8, 8) - 1), 1e-4);
    image_free(&pixels);
    close_room(&r);
}

static void set_lamp(room *r, float height, scene_light *lamp) {
    *lamp = (scene_light) {
        .emitter = { .position = { 0, height, 0 }, .radius = 0.2f, .radiance = { 2, 2, 2 } },
        .hidden = 1
    };
    light_by(r, lamp);
}

/* A lamp in the middle of a cube lights its walls by its power divided by their area, and each
 * bounce adds as much of it as is reflected. */
static void the_power_of_a_lamp_is_kept(void **state) {
    (void)state;
    const double rho = 0.6, power = 4 * M_PI * M_PI * 0.2 * 0.2 * 2;
    room r;
    scene_light lamp;
    open_room(cube_obj, "", rho, &r);
    set_lamp(&r, 0, &lamp);
    r.settings.camera = (scene_camera) {
        .eye = { 0, 0, 0.5f }, .target = { 0, 0, -1 }, .up = { 0, 1, 0 }, .height = 2
    };
    image pixels;
    const double expected = power / 24 * rho / M_PI * (1 - pow(rho, 9)) / (1 - rho);
    draw(&r, 8, true, &pixels);
    print_message("%.5f, expected %.5f\n", mean_of(&pixels), expected);
    CHECK_WITHIN(fabs(mean_of(&pixels) / expected - 1), 0.01);
    image_free(&pixels);
    close_room(&r);
}

/* Across less of a wall than surfels are apart, bounced light is read at the corners of the image,
 * and is linear between them, along both axes. */
static void between_pixels_that_are_read_light_is_linear(void **state) {
    (void)state;
    room r;
    scene_light lamp;
    image lit, direct;
    open_room(cube_obj, "", 0.6, &r);
    set_lamp(&r, 0, &lamp);
    lamp.emitter.position = (lmp_vec3) { 0.7f, -0.6f, -0.2f };
    r.settings.camera = (scene_camera) { .eye = { 0.6f, -0.7f, 0.5f },
                                         .target = { 0.6f, -0.7f, -1 },
                                         .up = { 0, 1, 0 },
                                         .height = 0.04f };
    draw(&r, 8, false, &lit);
    draw(&r, 0, false, &direct);
    for (int p = 0; p < 3 * PIXELS; p++)
        lit.rgb[p] -= direct.rgb[p];
    for (int axis = 0; axis < 2; axis++) {
        const int step = 3 * (axis ? SIDE : 1);
        const double first = (double)lit.rgb[0], rise = (double)lit.rgb[(SIDE - 1) * step] - first;
        assert_true(fabs(rise) > 1e-3 * first);
        for (int k = 1; k < SIDE - 1; k++)
            for (int c = 0; c < 3; c++)
                CHECK_WITHIN(fabs((double)lit.rgb[k * step + c] - first - rise * k / (SIDE - 1)),
                             0.02 * fabs(rise));
    }
    image_free(&lit);
    image_free(&direct);
    close_room(&r);
}

/* Beside a low block on the floor, less than half as far from it as surfels are apart, what it
 * hides of the light shows. */
static void detail_is_finer_than_surfels(void **state) {
    (void)state;
    static const char block[] =
        "usemtl wall\n"
        "v 0 -1 -0.3\nv 0 -1 0.3\nv 0 -0.9 0.3\nv 0 -0.9 -0.3\n"
        "v 0 -0.9 0.3\nv 0.5 -0.9 0.3\nv 0.5 -0.9 -0.3\nv 0 -0.9 -0.3\n"
        "v 0.5 -1 0.3\nv 0.5 -1 -0.3\nv 0.5 -0.9 -0.3\nv 0.5 -0.9 0.3\n"
        "v 0 -1 0.3\nv 0.5 -1 0.3\nv 0.5 -0.9 0.3\nv 0 -0.9 0.3\n"
        "v 0.5 -1 -0.3\nv 0 -1 -0.3\nv 0 -0.9 -0.3\nv 0.5 -0.9 -0.3\n"
        "f 25 26 27 28\nf 29 30 31 32\nf 33 34 35 36\nf 37 38 39 40\nf 41 42 43 44\n";
    char obj[sizeof cube_obj + sizeof block];
    room r;
    scene_light lamp;
    image lit, direct, exact, exact_direct, noise[2];
    base_error error = { "" };
    double sum = 0;
    snprintf(obj, sizeof obj, "%s%s", cube_obj, block);
    open_room(obj, "", 0.6, &r);
    set_lamp(&r, 0, &lamp);
    lamp.emitter.position = (lmp_vec3) { 0.6f, 0.2f, 0 };
    r.settings.camera = (scene_camera) { .eye = { -0.0105f, 0, 0 },
                                         .target = { -0.0105f, -1, 0 },
                                         .up = { 0, 0, -1 },
                                         .height = 0.02f };
    r.settings.samples = 4096;
    draw(&r, 8, true, &lit);
    draw(&r, 0, true, &direct);
    r.settings.bounces = 8;
    assert_true(reference_render(&r.world, &r.settings, &exact, &noise[0], &error));
    r.settings.bounces = 0;
    assert_true(reference_render(&r.world, &r.settings, &exact_direct, &noise[1], &error));
    for (int i = 0; i < 3 * PIXELS; i++) {
        const double expected = (double)exact.rgb[i] - (double)exact_direct.rgb[i];
        const double found = (double)lit.rgb[i] - (double)direct.rgb[i];
        sum += pow(found / expected - 1, 2) / (3 * PIXELS);
    }
    print_message("relative squared error %.5f\n", sum);
    CHECK_WITHIN(sum, 0.0015); /* surfels: 0.0029 */
    image_free(&lit);
    image_free(&direct);
    image_free(&exact);
    image_free(&exact_direct);
    image_free(&noise[0]);
    image_free(&noise[1]);
    close_room(&r);
}

/* The walls are infinitely thin. */
static void nothing_leaks_into_a_closed_room(void **state) {
    (void)state;
    room r;
    scene_light lamp;
    image pixels;
    open_room(cube_obj, "", 0.8, &r);
    set_lamp(&r, 3, &lamp);
    draw(&r, 8, true, &pixels);
    for (int i = 0; i < 3 * PIXELS; i++)
        assert_true(pixels.rgb[i] == 0);
    image_free(&pixels);
    close_room(&r);
}

/* --- in probes -------------------------------------------------------------------------------- */

enum { PROBES = 8, VALUES = 27 };

/* Makes probes at the corners of a box in the room. */
static void make_probes(const room *r, int bounces, int rays, volume *probes) {
    const environment none = { .bands = 0 };
    const volume_settings settings = {
        .grid = { { 2, 2, 2 }, { -0.5f, 0, -0.5f }, { 0.5f, 0.5f, 0.5f } },
        .bands = 3,
        .rays = rays,
        .bounces = bounces
    };
    base_error error = { "" };
    assert_true(volume_make(&r->world, &none, &settings, probes, &error));
    assert_int_equal(probes->probe_count, PROBES);
    assert_int_equal(probes->value_count, VALUES);
}

/* The same room around probes: to light of radiance 1 from everywhere, which nothing hides, each
 * bounce adds rho as much as the one before. */
static void probes_see_the_geometric_series(void **state) {
    (void)state;
    const int numbers[] = { 1, 2, 8 };
    for (int k = 0; k < 3; k++) {
        room r;
        volume probes;
        open_room(cube_obj, "", 0.8, &r);
        light_evenly(&r);
        make_probes(&r, numbers[k], 0, &probes);
        const double radiance = 1 + series_of(0.8, numbers[k] - 1);
        for (int i = 0; i < PROBES * VALUES; i++) {
            const double expected = i % VALUES % 9 == 0 ? 2 * sqrt(M_PI) * radiance : 0;
            CHECK_WITHIN(fabs((double)probes.values[i] - expected), 0.004 * radiance);
        }
        volume_free(&probes);
        close_room(&r);
    }
}

/* Whether a point over the floor sees it in a direction. */
static float sees_floor(lmp_vec3 direction, void *point) {
    const lmp_vec3 *p = point;
    const float t = (p->y + 1) / -direction.y;
    return direction.y < 0 && fabsf(p->x + t * direction.x) <= 9 &&
           fabsf(p->z + t * direction.z) <= 9;
}

/* Under a distant lamp a floor of albedo 0.6 has one radiance, and hides no light from itself. */
static void probes_see_the_floor_below_them(void **state) {
    (void)state;
    static const char floor_obj[] = "mtllib room.mtl\nusemtl floor\nv -9 -1 -9\nv -9 -1 9\n"
                                    "v 9 -1 9\nv 9 -1 -9\nf 1 2 3 4\n";
    const scene_light lamp = { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                                            .direction = { 0, 1, 0 },
                                            .radiance = { 2, 1, 0 } } };
    for (int rays = 0; rays <= 16; rays += 16) {
        room r;
        volume direct, bounced;
        open_room(floor_obj, "", 0.6, &r);
        light_by(&r, &lamp);
        make_probes(&r, 0, rays, &direct);
        make_probes(&r, 1, rays, &bounced);
        for (int i = 0; i < PROBES; i++) {
            lmp_vec3 point = { (float)(i % 2) - 0.5f, 0.5f * (float)(i / 2 % 2),
                               (float)(i / 4) - 0.5f };
            float floor[VALUES / 3];
            lmp_sh_project_function(3, 256, sees_floor, &point, floor);
            for (int v = 0; v < VALUES; v++) {
                const double radiance = 0.6 * (2 - v / 9) / M_PI;
                const double added =
                    (double)bounced.values[i * VALUES + v] - (double)direct.values[i * VALUES + v];
                CHECK_WITHIN(fabs(added - radiance * (double)floor[v % 9]), 0.03 * radiance + 1e-6);
            }
        }
        volume_free(&direct);
        volume_free(&bounced);
        close_room(&r);
    }
}

/* Rays are cast anew, not read from the user's cache. */
static int make_folder(void **state) {
    const int made = folder_make(state);
    setenv("XDG_CACHE_HOME", in_folder("cache"), 1);
    return made;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(even_light_keeps_the_geometric_series),
        cmocka_unit_test(the_exposure_sees_bounces),
        cmocka_unit_test(what_stands_on_a_wall_hides_it),
        cmocka_unit_test(the_power_of_a_lamp_is_kept),
        cmocka_unit_test(between_pixels_that_are_read_light_is_linear),
        cmocka_unit_test(detail_is_finer_than_surfels),
        cmocka_unit_test(nothing_leaks_into_a_closed_room),
        cmocka_unit_test(probes_see_the_geometric_series),
        cmocka_unit_test(probes_see_the_floor_below_them),
    };
    return cmocka_run_group_tests(tests, make_folder, folder_remove);
}
