/* SPDX-License-Identifier: MIT */
/* Light that bounces in the ground truth, in closed rooms where what every bounce adds is known. */
#include "app/truth/reference.h"
#include "tests/oracle/check.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <math.h>
#include <string.h>

enum { SIDE = 8, PIXELS = SIDE * SIDE };

/* A cube from -1 to 1, seen from inside, whose floor has a material of its own. Its sides overlap a
 * little and share no corners: a reader turns what is closed inside out. */
static const char cube_obj[] =
    "mtllib room.mtl\nusemtl wall\n"
    "v -1 -1.01 -1.01\nv -1 1.01 -1.01\nv -1 1.01 1.01\nv -1 -1.01 1.01\nf 1 2 3 4\n"
    "v 1 -1.01 1.01\nv 1 1.01 1.01\nv 1 1.01 -1.01\nv 1 -1.01 -1.01\nf 5 6 7 8\n"
    "v 1.01 1 -1.01\nv 1.01 1 1.01\nv -1.01 1 1.01\nv -1.01 1 -1.01\nf 9 10 11 12\n"
    "v -1.01 -1.01 -1\nv 1.01 -1.01 -1\nv 1.01 1.01 -1\nv -1.01 1.01 -1\nf 13 14 15 16\n"
    "v -1.01 1.01 1\nv 1.01 1.01 1\nv 1.01 -1.01 1\nv -1.01 -1.01 1\nf 17 18 19 20\n"
    "usemtl floor\n"
    "v -1.01 -1 -1.01\nv -1.01 -1 1.01\nv 1.01 -1 1.01\nv 1.01 -1 -1.01\nf 21 22 23 24\n";

/* A floor and a ceiling that both face up. */
static const char sheets_obj[] = "mtllib room.mtl\nusemtl floor\n"
                                 "v -9 -1 -9\nv -9 -1 9\nv 9 -1 9\nv 9 -1 -9\n"
                                 "v -9 1 -9\nv -9 1 9\nv 9 1 9\nv 9 1 -9\n"
                                 "f 1 2 3 4\nf 5 6 7 8\n";
static const char room_mtl[] = "newmtl wall\nKd 1 1 1\nKs 0 0 0\nNs 0\n%s"
                               "newmtl floor\nKd 1 1 1\nKs 0 0 0\nNs 0\n%s";

typedef struct room {
    scene world;
    scene_material materials[8];
    scene_light light, *lights_of_file;
    reference_settings settings;
} room;

/* Opens the room with walls that reflect as Lambert's law says, and emit what OBJ's Ke says. */
static void open_room(const char *obj, const char *emission, double albedo, room *r) {
    char mtl[400];
    snprintf(mtl, sizeof mtl, room_mtl, emission, emission);
    folder_write_text("room.mtl", mtl);
    folder_write_text("room.obj", obj);
    r->world = load(in_folder("room.obj"));
    assert_true(r->world.material_count <= 8);
    memcpy(r->materials, r->world.materials, r->world.material_count * sizeof *r->materials);
    for (size_t i = 0; i < r->world.material_count; i++) {
        r->materials[i].flags = 0;
        r->materials[i].f90 = 0;
        for (int c = 0; c < 3; c++) {
            r->materials[i].base_color[c] = (float)albedo;
            r->materials[i].f0[c] = 0;
        }
    }
    r->world.materials = r->materials;
    r->lights_of_file = NULL;
    r->settings = (reference_settings) {
        .width = SIDE,
        .height = SIDE,
        .camera = { .eye = { 0, 0.3f, 0.6f },
                    .target = { 0.1f, -0.4f, -1 },
                    .up = { 0, 1, 0 },
                    .fov = 1.5f },
        .samples = 512,
        .seed = 3,
        .shadows = true,
    };
}

/* Replaces the lights by another. */
static void light_by(room *r, const scene_light *light) {
    r->light = *light;
    r->lights_of_file = r->world.lights;
    r->world.lights = &r->light;
    r->world.light_count = 1;
}

/* Lets radiance 1 come from all directions, without shadows. */
static void light_evenly(room *r) {
    const scene_light even = { .emitter = { .kind = LMP_LIGHT_HEMISPHERE,
                                            .direction = { 0, 1, 0 },
                                            .radiance = { 1, 1, 1 },
                                            .ground = { 1, 1, 1 } } };
    light_by(r, &even);
    r->settings.shadows = false;
}

static void close_room(room *r) {
    if (r->lights_of_file)
        r->world.lights = r->lights_of_file;
    scene_free(&r->world);
}

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
