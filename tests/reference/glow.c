/* SPDX-License-Identifier: MIT */
/* Emissive meshes on the CPU and in the reference, against exact values of a white floor. */
#include "app/render/renderer/renderer.h"
#include "app/render/renderer/shadows.h"
#include "app/truth/reference.h"
#include "tests/oracle/check.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The white floor, which reflects nothing else, and what glows with a radiance of 10. */
static const char materials[] = "newmtl floor\nKd 1 1 1\nKs 0 0 0\nNs 0\n"
                                "newmtl glow\nKd 0 0 0\nKs 0 0 0\nKe 10 10 10\n";
static const char floor_obj[] = "mtllib glow.mtl\nusemtl floor\n"
                                "v -5 0 -5\nv -5 0 5\nv 5 0 5\nv 5 0 -5\nf 1 2 3 4\nusemtl glow\n";

static char text[1 << 16];

static void add_vertex(double x, double y, double z) {
    const size_t used = strlen(text);
    snprintf(text + used, sizeof text - used, "v %.9g %.9g %.9g\n", x, y, z);
}

static void add_face(int a, int b, int c, int d) {
    const size_t used = strlen(text);
    snprintf(text + used, sizeof text - used, "f %d %d %d %d\n", a, b, c, d);
}

/* Loads the mesh over a floor that reflects as Lambert's law says, without a surface that shines.
 */
static scene load_glow(void) {
    static scene_material matte[8];
    folder_write_text("glow.mtl", materials);
    folder_write_text("glow.obj", text);
    scene world = load(in_folder("glow.obj"));
    assert_true(world.material_count <= 8);
    memcpy(matte, world.materials, world.material_count * sizeof *matte);
    for (size_t i = 0; i < world.material_count; i++) {
        matte[i].f90 = 0;
        for (int c = 0; c < 3; c++) {
            matte[i].base_color[c] = 1;
            matte[i].f0[c] = 0;
        }
    }
    world.materials = matte;
    return world;
}

/* A panel 1 x 1 that faces the floor from a height of 3. */
static void write_panel(void) {
    snprintf(text, sizeof text, "%s", floor_obj);
    add_vertex(-0.5, 3, -0.5);
    add_vertex(0.5, 3, -0.5);
    add_vertex(0.5, 3, 0.5);
    add_vertex(-0.5, 3, 0.5);
    add_face(5, 6, 7, 8);
}

/* A closed tube of many sides along x, at a height of 2. */
static void write_tube(int sides, double radius, double half) {
    snprintf(text, sizeof text, "%s", floor_obj);
    for (int i = 0; i < sides; i++)
        for (int end = -1; end <= 1; end += 2) {
            const double angle = 2 * M_PI * (i + 0.5) / sides;
            add_vertex(end * half, 2 + radius * cos(angle), radius * sin(angle));
        }
    add_vertex(-half, 2, 0);
    add_vertex(half, 2, 0);
    for (int i = 0; i < sides; i++) {
        const int a = 5 + 2 * i, b = 5 + 2 * ((i + 1) % sides);
        const size_t used = strlen(text);
        add_face(a, a + 1, b + 1, b);
        snprintf(text + strlen(text), sizeof text - used - 64, "f %d %d %d\nf %d %d %d\n", a, b,
                 5 + 2 * sides, b + 1, a + 1, 6 + 2 * sides);
    }
}

enum { SIZE = 3 };

static float middle_of(const image *pixels) {
    return pixels->rgb[3 * (SIZE / 2 * SIZE + SIZE / 2)];
}

static scene_camera camera_at(float x, float y, float z) {
    return (scene_camera) { .eye = { x, y, z }, .up = { 0, 1, 0 }, .fov = 0.1f };
}

static double draw(const scene *world, const scene_camera *camera) {
    const shadow_settings settings = { .rays = 64, .raw = true };
    base_error error = { "" };
    render_device device;
    image pixels;
    render_frame frame = { .width = SIZE,
                           .height = SIZE,
                           .camera = *camera,
                           .method = METHOD_ZONAL,
                           .bands = 8,
                           .lights = world->lights,
                           .light_count = world->light_count };
    assert_true(render_device_open(DEVICE_CPU, NULL, world, &device, &error));
    any_renderer *renderer = renderer_create(&device, &error);
    shadow *caster = render_device_shadow(&device, NULL, &settings, &error);
    assert_true(renderer && caster);
    frame.shadow = shadow_pass(caster);
    assert_true(renderer_draw(renderer, &frame, NULL, &error));
    assert_true(renderer_read_image(renderer, &pixels, &error));
    const double value = (double)middle_of(&pixels);
    image_free(&pixels);
    shadow_destroy(caster);
    renderer_destroy(renderer);
    render_device_close(&device);
    return value;
}

static double trace(const scene *world, const scene_camera *camera, double *standard_error) {
    const reference_settings settings = { .width = SIZE,
                                          .height = SIZE,
                                          .camera = *camera,
                                          .samples = 16384,
                                          .seed = 1,
                                          .shadows = true };
    base_error error;
    image truth, noise;
    assert_true(reference_render(world, &settings, &truth, &noise, &error));
    const double value = (double)middle_of(&truth);
    *standard_error = (double)middle_of(&noise);
    image_free(&truth);
    image_free(&noise);
    return value;
}

/* Checks what the camera sees: within 2 % of the exact value in the image, within noise, and what
 * straight sides leave of round ones, in the reference. */
static void check(const scene *world, const scene_camera *camera, double exact, double sides) {
    double noise;
    const double drawn = draw(world, camera), truth = trace(world, camera, &noise);
    print_message("exact %.4f, image %.4f, reference %.4f ± %.4f\n", exact, drawn, truth, noise);
    CHECK_WITHIN(fabs(drawn - exact), 0.02 * exact);
    CHECK_WITHIN(fabs(truth - exact), 4 * noise + sides * exact + 1e-6);
    CHECK_WITHIN(noise, 0.02 * exact + 1e-9);
}

/* The irradiance under the middle of a rectangle 2a x 2b at a height (Lambert). */
static double under_rectangle(double a, double b, double height) {
    const double x = sqrt(a * a + height * height), y = sqrt(b * b + height * height);
    return 2 * (a / x * atan(b / x) + b / y * atan(a / y));
}

static void a_panel_lights_the_floor(void **state) {
    (void)state;
    write_panel();
    scene world = load_glow();
    const scene_camera down = camera_at(0, 2, 1);
    assert_int_equal(world.light_count, 1);
    assert_int_equal(world.lights[0].emitter.kind, LMP_LIGHT_RECTANGLE);
    check(&world, &down, 10 * under_rectangle(0.5, 0.5, 3) / M_PI, 0);
    scene_free(&world);
}

/* The exposure is found from what the panel lights, not from its dark mesh. */
static void the_meter_sees_the_floor(void **state) {
    (void)state;
    write_panel();
    scene world = load_glow();
    const scene_camera down = camera_at(0, 2, 1);
    const reference_settings settings = { .width = SIZE, .height = SIZE, .camera = down };
    base_error error;
    image metered;
    assert_true(reference_meter(&world, &settings, &metered, &error));
    const double exact = 10 * under_rectangle(0.5, 0.5, 3) / M_PI;
    CHECK_WITHIN(fabs((double)middle_of(&metered) - exact), 0.02 * exact);
    image_free(&metered);
    scene_free(&world);
}

/* A white panel shows its own radiance: it lights neither itself nor, below it, its plane. */
static void a_panel_shows_its_own_radiance(void **state) {
    (void)state;
    write_panel();
    scene world = load_glow();
    scene_camera up = camera_at(0.1f, 1, 0.2f);
    double noise;
    up.target[0] = 0.3f;
    up.target[1] = 3;
    up.target[2] = 0.1f;
    /* The floor lights nothing: there are no bounces. */
    CHECK_WITHIN(fabs(draw(&world, &up) - 10), 1e-3);
    CHECK_WITHIN(fabs(trace(&world, &up, &noise) - 10), 1e-3);
    scene_free(&world);
}

/* The irradiance under the middle of a long tube is that of its axis, of radiance times diameter:
 * 2 r L (half / (h² + half²) + atan(half / h) / h), where it is thin. */
static void a_tube_lights_the_floor(void **state) {
    (void)state;
    const double r = 0.02, half = 3, h = 2;
    write_tube(24, r, half);
    scene world = load_glow();
    const scene_camera down = camera_at(0, 1, 1);
    assert_int_equal(world.light_count, 1);
    assert_int_equal(world.lights[0].emitter.kind, LMP_LIGHT_TUBE);
    const double exact = 10 * 2 * r * (half / (h * h + half * half) + atan(half / h) / h) / M_PI;
    check(&world, &down, exact, 0.01);
    scene_free(&world);
}

/* One of a few sides is as many rectangles. */
static void a_bar_lights_the_floor(void **state) {
    (void)state;
    const double r = 0.02, half = 3, h = 2, c = r / sqrt(2);
    write_tube(4, r, half);
    scene world = load_glow();
    const scene_camera down = camera_at(0, 1, 1);
    assert_int_equal(world.light_count, 6);
    check(&world, &down, 10 * under_rectangle(half, c, h - c) / M_PI, 0);
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_panel_lights_the_floor),
        cmocka_unit_test(the_meter_sees_the_floor),
        cmocka_unit_test(a_panel_shows_its_own_radiance),
        cmocka_unit_test(a_tube_lights_the_floor),
        cmocka_unit_test(a_bar_lights_the_floor),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
