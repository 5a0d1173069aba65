/* SPDX-License-Identifier: MIT */
/* Emissive meshes on the CPU and in the reference, against exact values of a white floor. */
#include "app/image/png.h"
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
static scene load_glow_by(const char *mtl) {
    static scene_material matte[8];
    folder_write_text("glow.mtl", mtl);
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

static scene load_glow(void) {
    return load_glow_by(materials);
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

/* --- textures --------------------------------------------------------------------------------- */

/* The irradiance from a rectangle x0 … x1, z0 … z1 at a height, at the origin: the sum over its
 * corners of what lies between them and the point above it. */
static double corner_irradiance(double a, double b, double height) {
    const double x = sqrt(a * a + height * height), y = sqrt(b * b + height * height);
    return 0.5 * (a / x * atan(b / x) + b / y * atan(a / y));
}

static double rectangle_irradiance(double x0, double x1, double z0, double z1, double height) {
    return corner_irradiance(x1, z1, height) - corner_irradiance(x0, z1, height) -
           corner_irradiance(x1, z0, height) + corner_irradiance(x0, z0, height);
}

/* Writes an emission map whose left part is bright: `bright` of 64 columns. */
static void write_map(int bright) {
    static unsigned char rgb[64 * 64 * 3];
    base_error error;
    for (int i = 0; i < 64 * 64; i++)
        memset(rgb + 3 * i, i % 64 < bright ? 255 : 0, 3);
    assert_true(image_write_png8(rgb, 64, 64, in_folder("map.png"), &error));
}

static void load_textured(scene *world) {
    *world = load_glow_by("newmtl floor\nKd 1 1 1\nKs 0 0 0\nNs 0\n"
                          "newmtl glow\nKd 0 0 0\nKs 0 0 0\nKe 10 10 10\nmap_Ke map.png\n");
}

/* A panel of which the half at x < 0 is bright. */
static void write_textured_panel(void) {
    write_panel();
    *strstr(text, "f 5 6 7 8") = '\0';
    strcat(text, "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 5/1 6/2 7/3 8/4\n");
}

/* In the image a panel has its mean radiance, which at its middle is exact; the reference looks its
 * texture up. */
static void a_textured_panel_lights_the_floor(void **state) {
    (void)state;
    scene world;
    double noise;
    write_textured_panel();
    write_map(32);
    load_textured(&world);
    assert_int_equal(world.light_count, 1);
    assert_int_equal(world.lights[0].emitter.kind, LMP_LIGHT_RECTANGLE);
    CHECK_WITHIN(fabs((double)world.lights[0].emitter.radiance.g - 5), 0.05);
    const scene_camera down = camera_at(0, 2, 1);
    check(&world, &down, 10 * rectangle_irradiance(-0.5, 0, -0.5, 0.5, 3) / M_PI, 0.01);
    for (int side = -1; side <= 1; side += 2) {
        scene_camera beside = camera_at(2 * (float)side, 2, 1);
        beside.target[0] = 2 * (float)side;
        const double x = -2.0 * side;
        const double exact = 10 * rectangle_irradiance(x - 0.5, x, -0.5, 0.5, 3) / M_PI;
        CHECK_WITHIN(fabs(trace(&world, &beside, &noise) - exact), 4 * noise + 0.01 * exact);
    }
    scene_free(&world);
}

/* Of an atlas on many panels those light that are bright in it. */
static void dark_parts_of_a_mesh_light_nothing(void **state) {
    (void)state;
    scene world;
    snprintf(text, sizeof text, "%s", floor_obj);
    strcat(text, "vt 0.05 0.1\nvt 0.1 0.1\nvt 0.1 0.2\nvt 0.6 0.1\nvt 0.7 0.1\nvt 0.7 0.2\n");
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++)
            add_vertex(i + (k == 1 || k == 2), 3, k < 2 ? -0.5 : 0.5);
        const int v = 5 + 4 * i, t = i == 1 ? 1 : 4;
        snprintf(text + strlen(text), 200, "f %d/%d %d/%d %d/%d %d/%d\n", v, t, v + 1, t + 1, v + 2,
                 t + 2, v + 3, t);
    }
    write_map(32);
    load_textured(&world);
    assert_int_equal(world.light_count, 1);
    CHECK_WITHIN(fabs((double)world.lights[0].emitter.position.x - 1.5), 1e-6);
    CHECK_WITHIN(fabs((double)world.lights[0].emitter.radiance.r - 10), 1e-5);
    scene_free(&world);
    write_map(0);
    load_textured(&world);
    assert_int_equal(world.light_count, 0);
    scene_free(&world);
}

/* An emission map that cannot be decoded leaves the mesh without light, as it is without glow. */
static void an_unreadable_map_lights_nothing(void **state) {
    (void)state;
    scene world;
    write_textured_panel();
    write_map(32);
    FILE *file = fopen(in_folder("map.png"), "r+b");
    assert_true(file && fseek(file, 60, SEEK_SET) == 0 && fputs("damaged", file) >= 0);
    fclose(file);
    load_textured(&world);
    assert_int_equal(world.light_count, 0);
    scene_free(&world);
}

/* --- pieces ----------------------------------------------------------------------------------- */

/* Adds a ball of 8 x 16 faces, whose vertices are as many as follow each other. */
static void add_ball(double x, double y, double z, double r, int *vertices) {
    const int first = *vertices + 1;
    for (int ring = 0; ring <= 8; ring++)
        for (int i = 0; i < 16; i++) {
            const double polar = M_PI * ring / 8, around = 2 * M_PI * i / 16;
            add_vertex(x + r * sin(polar) * cos(around), y + r * cos(polar),
                       z - r * sin(polar) * sin(around));
        }
    for (int ring = 0; ring < 8; ring++)
        for (int i = 0; i < 16; i++) {
            const int a = first + 16 * ring + i, b = first + 16 * ring + (i + 1) % 16;
            add_face(a, a + 16, b + 16, b);
        }
    *vertices += 9 * 16;
}

/* Balls of one mesh are lights where they are, the strongest first. Their chords make them shine a
 * little less. */
static void every_piece_shines_where_it_is(void **state) {
    (void)state;
    int vertices = 4;
    snprintf(text, sizeof text, "%s", floor_obj);
    add_ball(-3, 2, 0, 0.25, &vertices);
    add_ball(3, 2, 0, 0.5, &vertices);
    scene world = load_glow();
    assert_int_equal(world.light_count, 2);
    for (int i = 0; i < 2; i++) {
        const lmp_light *light = &world.lights[i].emitter;
        assert_int_equal(light->kind, LMP_LIGHT_SPHERE);
        CHECK_WITHIN(fabs((double)light->position.x - (i ? -3 : 3)), 1e-5);
        CHECK_WITHIN(fabs((double)light->radius - (i ? 0.25 : 0.5)), 1e-5);
        CHECK_WITHIN(fabs((double)light->radiance.g - 9.6), 0.3);
    }
    /* E = pi L sin²a cos, of both */
    const scene_camera down = camera_at(0, 1, 1);
    const double d2 = 3 * 3 + 2 * 2, l = (double)world.lights[0].emitter.radiance.g;
    check(&world, &down, l * (0.0625 + 0.25) / d2 * 2 / sqrt(d2), 0.02);
    scene_free(&world);
}

/* A ribbon, bent to three quarters of a ring, of more faces than lights, which shines inward and
 * outward alike: the sphere around it has the power of both sides. */
static void both_sides_of_an_open_piece_shine(void **state) {
    (void)state;
    enum { SEGMENTS = 50, CORNERS = 6 * SEGMENTS };
    static const int end_of[6] = { 0, 1, 1, 0, 1, 0 }, side_of[6] = { 0, 0, 1, 0, 1, 1 };
    static float at[CORNERS][3];
    char json[1024];
    double area = 0;
    for (int i = 0; i < CORNERS; i++) {
        const double angle = 1.5 * M_PI * (i / 6 + end_of[i % 6]) / SEGMENTS;
        at[i][0] = (float)cos(angle);
        at[i][1] = 0.1f * (float)side_of[i % 6];
        at[i][2] = (float)sin(angle);
    }
    for (int i = 0; i < CORNERS; i += 3) {
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = (double)at[i + 1][k] - (double)at[i][k];
            b[k] = (double)at[i + 2][k] - (double)at[i][k];
        }
        area += hypot(hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2]),
                      a[0] * b[1] - a[1] * b[0]) /
                2;
    }
    snprintf(
        json, sizeof json,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"materials\":[{\"doubleSided\":true,\"emissiveFactor\":[1,1,1]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
        "\"buffers\":[{\"uri\":\"ribbon.bin\",\"byteLength\":%d}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%d,"
        "\"type\":\"VEC3\",\"min\":[-1,0,-1],\"max\":[1,0.1,1]}]}",
        (int)sizeof at, (int)sizeof at, CORNERS);
    folder_write("ribbon.bin", at, sizeof at);
    folder_write_text("ribbon.gltf", json);
    scene world = load(in_folder("ribbon.gltf"));
    assert_int_equal(world.light_count, 1);
    const lmp_light *light = &world.lights[0].emitter;
    assert_int_equal(light->kind, LMP_LIGHT_SPHERE);
    CHECK_WITHIN(fabs((double)lmp_sphere_power_from_radiance(light->radiance.g, light->radius) -
                      2 * M_PI * area),
                 1e-4 * area);
    scene_free(&world);
}

/* A strip that is bent lengthwise, beside a ball: a rectangle as long and wide. Its ends are a
 * tenth of its height higher than its middle, where the rectangle is. */
static void a_bent_strip_is_a_rectangle(void **state) {
    (void)state;
    const double bend = 6, half = 0.25, width = 0.2, height = 2;
    int vertices = 4;
    snprintf(text, sizeof text, "%s", floor_obj);
    for (int i = 0; i <= 12; i++)
        for (int side = -1; side <= 1; side += 2) {
            const double angle = half * (i - 6) / 6;
            add_vertex(bend * sin(angle), height + bend * (1 - cos(angle)), side * width / 2);
        }
    for (int i = 0; i < 12; i++)
        add_face(vertices + 2 * i + 1, vertices + 2 * i + 3, vertices + 2 * i + 4,
                 vertices + 2 * i + 2);
    vertices += 26;
    add_ball(4, 3, 4, 0.05, &vertices);
    scene world = load_glow();
    assert_int_equal(world.light_count, 2);
    const lmp_light *light = &world.lights[0].emitter;
    assert_int_equal(light->kind, LMP_LIGHT_RECTANGLE);
    const double x = bend * sin(half), area = 4 * x * width / 2;
    CHECK_WITHIN(fabs(fabs((double)light->half[0].x) - x), 0.02 * x);
    CHECK_WITHIN(fabs(fabs((double)light->half[1].z) - width / 2), 0.02 * width / 2);
    CHECK_WITHIN(fabs((double)light->position.y - height), 1e-5);
    CHECK_WITHIN(fabs((double)lmp_light_power_from_radiance(light, light->radiance.g) -
                      M_PI * 10 * area * half / sin(half)),
                 0.01 * M_PI * 10 * area);
    const scene_camera down = camera_at(0, 1, 1);
    double noise;
    const double drawn = draw(&world, &down), truth = trace(&world, &down, &noise);
    CHECK_WITHIN(fabs(drawn - truth), 0.1 * truth);
    scene_free(&world);
}

/* Of a hundred balls the largest have the power of all. */
static void the_strongest_pieces_have_all_power(void **state) {
    (void)state;
    int vertices = 4;
    double power = 0;
    snprintf(text, sizeof text, "%s", floor_obj);
    for (int i = 0; i < 100; i++) { /* tetrahedra whose faces have areas of sqrt(3) / 2 times r² */
        const double r = i < 50 ? 0.02 : 0.001, x = i % 10, z = (double)(i / 10) / 2;
        add_vertex(x, 2, z);
        add_vertex(x + r, 2 + r, z);
        add_vertex(x + r, 2, z + r);
        add_vertex(x, 2 + r, z + r);
        const int a = vertices + 1;
        snprintf(text + strlen(text), 200, "f %d %d %d\nf %d %d %d\nf %d %d %d\nf %d %d %d\n", a,
                 a + 1, a + 2, a, a + 2, a + 3, a, a + 3, a + 1, a + 1, a + 3, a + 2);
        vertices += 4;
        power += M_PI * 10 * 4 * sqrt(3) / 2 * r * r;
    }
    scene world = load_glow();
    assert_int_equal(world.light_count, 40);
    double found = 0;
    for (size_t i = 0; i < world.light_count; i++) {
        const lmp_light *light = &world.lights[i].emitter;
        found += (double)lmp_sphere_power_from_radiance(light->radiance.g, light->radius);
    }
    CHECK_WITHIN(fabs(found - power), 1e-3 * power);
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_panel_lights_the_floor),
        cmocka_unit_test(the_meter_sees_the_floor),
        cmocka_unit_test(a_panel_shows_its_own_radiance),
        cmocka_unit_test(a_tube_lights_the_floor),
        cmocka_unit_test(a_bar_lights_the_floor),
        cmocka_unit_test(a_textured_panel_lights_the_floor),
        cmocka_unit_test(dark_parts_of_a_mesh_light_nothing),
        cmocka_unit_test(an_unreadable_map_lights_nothing),
        cmocka_unit_test(every_piece_shines_where_it_is),
        cmocka_unit_test(both_sides_of_an_open_piece_shine),
        cmocka_unit_test(a_bent_strip_is_a_rectangle),
        cmocka_unit_test(the_strongest_pieces_have_all_power),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
