/* SPDX-License-Identifier: MIT */
/* Environments: directions of an image's colors, its coefficients, and what is refused. */
#include "app/scene/environment.h"
#include "app/scene/instance.h"
#include "app/scene/vector.h"
#include "tests/program/folder.h"

#include <lampion/shade.h>

#include <math.h>

static scene lit_scene(void) {
    static scene_light lamp;
    return (scene) { .maximum = { 1, 1, 1 }, .lights = &lamp, .light_count = 1, .name = "test" };
}

static image filled(int width, int height, float red) {
    base_error error;
    image pixels;
    assert_true(image_create(&pixels, width, height, &error));
    for (int i = 0; i < width * height; i++)
        pixels.rgb[3 * i] = red, pixels.rgb[3 * i + 1] = 2 * red, pixels.rgb[3 * i + 2] = 4 * red;
    return pixels;
}

/* Writes an image and opens it as an environment. */
static bool opens(const image *pixels, float rotation, float strength, environment *e,
                  base_error *error) {
    const scene world = lit_scene();
    const environment_options options = { .name = in_folder("map.exr"),
                                          .rotation = rotation,
                                          .strength = strength };
    *error = (base_error) { .text = "" };
    if (!image_write(pixels, options.name, &(image_display) { .exposure = 1 }, error))
        fail_msg("%s", error->text);
    return environment_open(&options, &world, e, error);
}

static void expect_seen(const environment *e, float x, float y, float z, double red) {
    const lmp_rgb seen = environment_seen(e, (float[]) { x, y, z });
    CHECK_WITHIN(fabs((double)seen.r - red), 1e-5);
}

static void an_even_image_is_an_even_light(void **state) {
    (void)state;
    image pixels = filled(64, 32, 1.5f);
    environment e;
    base_error error;
    assert_true(opens(&pixels, 33, 2, &e, &error));
    assert_true(environment_project(&e, 6, &error));
    /* Radiances are at most 42; pixels count by their centers. */
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 36; i++)
            CHECK_WITHIN(
                fabs((double)e.sh[36 * c + i] - (i == 0 ? 3 * (1 << c) * sqrt(4 * M_PI) : 0)),
                0.04);
    expect_seen(&e, 1, 2, 3, 3);
    environment_free(&e);
    image_free(&pixels);
}

/* The center column is +x and columns run toward +z; a quarter turn moves +x to -z. */
static void directions_and_rotations_are_as_documented(void **state) {
    (void)state;
    image pixels = filled(8, 4, 0);
    environment e;
    base_error error;
    for (int x = 4; x < 6; x++) /* from the center to +x, and to +z */
        pixels.rgb[3 * (8 + x)] = pixels.rgb[3 * (16 + x)] = 1;
    assert_true(opens(&pixels, 0, 1, &e, &error));
    expect_seen(&e, 1, 0, 1, 1);
    expect_seen(&e, 1, 0, -1, 0);
    expect_seen(&e, -1, 0, 1, 0);
    environment_free(&e);
    assert_true(opens(&pixels, 90, 1, &e, &error));
    expect_seen(&e, 1, 0, -1, 1);
    expect_seen(&e, 1, 0, 1, 0);
    /* The series is largest there, too. */
    assert_true(environment_project(&e, 3, &error));
    const float root_half = (float)sqrt(0.5);
    const lmp_vec3 bright = { root_half, 0, -root_half }, dark = { -root_half, 0, root_half };
    assert_true(lmp_sh_reconstruct(3, e.sh, bright) > lmp_sh_reconstruct(3, e.sh, dark) + 0.5f);
    environment_free(&e);
    image_free(&pixels);
}

/* The faces' columns and rows in a cross, with the axis of each; the middle face is -z. */
static void crosses_are_unfolded(void **state) {
    (void)state;
    static const int wide[6][2] = { { 1, 1 }, { 2, 1 }, { 0, 1 }, { 1, 0 }, { 1, 2 }, { 3, 1 } };
    static const int tall[6][2] = { { 1, 1 }, { 2, 1 }, { 0, 1 }, { 1, 0 }, { 1, 2 }, { 1, 3 } };
    static const float axes[6][3] = { { 0, 0, -1 }, { 1, 0, 0 },  { -1, 0, 0 },
                                      { 0, 1, 0 },  { 0, -1, 0 }, { 0, 0, 1 } };
    enum { SIZE = 8 };
    for (int kind = 0; kind < 2; kind++) {
        image pixels = filled(kind ? 3 * SIZE : 4 * SIZE, kind ? 4 * SIZE : 3 * SIZE, 0);
        environment e;
        base_error error;
        for (int i = 0; i < 6; i++) {
            const int *position = kind ? tall[i] : wide[i];
            for (int y = 0; y < SIZE; y++)
                for (int x = 0; x < SIZE; x++)
                    pixels.rgb[3 *
                               ((position[1] * SIZE + y) * pixels.width + position[0] * SIZE + x)] =
                        (float)(i + 1) + (i == 5 && !kind ? (y < SIZE / 2 ? 0.5f : 0) : 0) +
                        (i == 5 && kind ? (y >= SIZE / 2 ? 0.5f : 0) : 0);
        }
        assert_true(opens(&pixels, 0, 1, &e, &error));
        for (int i = 0; i < 5; i++)
            expect_seen(&e, axes[i][0], axes[i][1], axes[i][2], i + 1);
        /* The upper half of the face behind is brighter: in a tall cross it hangs upside down. */
        expect_seen(&e, 0.1f, 0.5f, 1, 6.5);
        expect_seen(&e, 0.1f, -0.5f, 1, 6);
        environment_free(&e);
        image_free(&pixels);
    }
}

/* Large images are averaged first, which must not change few bands. */
static void a_large_image_has_the_coefficients_of_all_its_pixels(void **state) {
    (void)state;
    enum { WIDTH = 1024, HEIGHT = 512, BANDS = 5 };
    image pixels = filled(WIDTH, HEIGHT, 0);
    environment e;
    base_error error;
    float direct[3 * BANDS * BANDS];
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        pixels.rgb[i] = (float)check_random();
    const lmp_latlong map = {
        .pixels = pixels.rgb, .width = WIDTH, .height = HEIGHT, .channels = 3
    };
    lmp_sh_project_latlong(BANDS, &map, direct);
    assert_true(opens(&pixels, 0, 1, &e, &error));
    assert_true(environment_project(&e, BANDS, &error));
    for (int i = 0; i < 3 * BANDS * BANDS; i++)
        CHECK_WITHIN(fabs((double)e.sh[i] - (double)direct[i]), 1e-3);
    environment_free(&e);
    image_free(&pixels);
}

static void what_is_no_environment_is_refused(void **state) {
    (void)state;
    environment e;
    base_error error;
    image square = filled(8, 8, 1), hole = filled(8, 4, 1), negative = filled(8, 4, -1);
    hole.rgb[3 * (8 + 5)] = NAN;
    assert_false(opens(&square, 0, 1, &e, &error));
    assert_non_null(strstr(error.text, "is 8 x 8 pixels: no panorama of 2:1"));
    assert_false(opens(&hole, 0, 1, &e, &error));
    assert_non_null(strstr(error.text, "a pixel (5, 1) that is not finite"));
    hole.rgb[3 * (8 + 5)] = 2e19f;
    assert_false(opens(&hole, 0, 1, &e, &error));
    assert_non_null(strstr(error.text, "a pixel (5, 1) that is not finite, or above 1e19"));
    assert_true(opens(&negative, 0, 1, &e, &error)); /* the ringing of a filter */
    expect_seen(&e, 1, 0, 0, 0);
    environment_free(&e);
    const scene world = lit_scene();
    const char *const names[] = { "missing.hdr", "photo.jpg", "none.exr" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const environment_options options = { .name = names[i], .strength = 1 };
        assert_false(environment_open(&options, &world, &e, &error));
        assert_non_null(strstr(error.text, names[i]));
    }
    image_free(&square);
    image_free(&hole);
    image_free(&negative);
}

/* Makes a floor, seen from above, and a lamp over or under it, which stands for a mesh or not. */
static scene glowing_scene(float height, uint32_t hidden) {
    static scene_vertex vertices[4];
    static const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    static scene_mesh mesh = { .index_count = 6 };
    static scene_instance instance;
    static scene_material material;
    static scene_light light;
    static const float corners[4][2] = { { -1, 1 }, { 1, 1 }, { 1, -1 }, { -1, -1 } };
    for (int i = 0; i < 4; i++) {
        vertices[i].position[0] = corners[i][0];
        vertices[i].position[1] = 0;
        vertices[i].position[2] = corners[i][1];
    }
    instance = scene_instance_identity(0);
    light = (scene_light) {
        .emitter = { .position = { 0, height, 0 }, .radius = 0.1f, .radiance = { 1, 1, 1 } },
        .hidden = hidden
    };
    return (scene) { .vertices = vertices,
                     .vertex_count = 4,
                     .indices = indices,
                     .index_count = 6,
                     .meshes = &mesh,
                     .mesh_count = 1,
                     .instances = &instance,
                     .instance_count = 1,
                     .materials = &material,
                     .material_count = 1,
                     .lights = &light,
                     .light_count = 1,
                     .minimum = { -1, 0, -1 },
                     .maximum = { 1, 0, 1 } };
}

static void the_studio_shines_where_what_glows_lights_little(void **state) {
    (void)state;
    const environment_options none = ENVIRONMENT_DEFAULTS;
    const scene over = glowing_scene(1, 1);
    assert_string_equal(environment_choose(&none, &over).name, "none");
    const scene under = glowing_scene(-1, 1);
    assert_string_equal(environment_choose(&none, &under).name, "studio");
    for (int strength = 1; strength <= 2; strength++) { /* emission that is paper's, and brighter */
        const scene faint = glowing_scene(1, 1);
        scene_instance both[2] = { faint.instances[0], scene_instance_identity(1) };
        scene_mesh meshes[2] = { faint.meshes[0], { .material = 1 } };
        scene_material materials[2] = { faint.materials[0],
                                        { .emission = { 1, 0.5f, (float)strength } } };
        scene two = faint;
        two.instances = both;
        two.meshes = meshes;
        two.materials = materials;
        two.instance_count = two.mesh_count = two.material_count = 2;
        two.lights[0].glow = 2;
        assert_string_equal(environment_choose(&none, &two).name, strength > 1 ? "none" : "studio");
        two.lights[0].glow = 0;
    }
    const scene lamp = glowing_scene(-1, 0); /* a light that is not a mesh */
    assert_string_equal(environment_choose(&none, &lamp).name, "none");
    /* The scene has the exposure of the studio alone, however that is chosen, but not beside a
     * lamp. */
    const char *const names[] = { NULL, "studio" };
    for (int i = 0; i < 2; i++) {
        const environment_options options = { .name = names[i], .strength = 1 };
        const scene dark = glowing_scene(-1, 1);
        environment e;
        base_error error;
        assert_true(environment_open(&options, &dark, &e, &error));
        assert_true(e.studio && environment_exposure(&e, 1) > 0 &&
                    environment_exposure(&e, 2) <= 0);
        environment_free(&e);
    }
}

static void the_strength_scales_what_shines_and_what_is_seen(void **state) {
    (void)state;
    const scene world = lit_scene();
    environment e[2];
    base_error error;
    for (int i = 0; i < 2; i++)
        assert_true(
            environment_open(&(environment_options) { .name = "studio", .strength = i ? 4 : 1 },
                             &world, &e[i], &error));
    assert_true(e[0].light.rgb[0] > 0 && e[0].backdrop.rgb[0] > 0);
    assert_true(e[1].light.rgb[0] == 4 * e[0].light.rgb[0]);
    assert_true(e[1].backdrop.rgb[0] == 4 * e[0].backdrop.rgb[0]);
    environment_free(&e[0]);
    environment_free(&e[1]);
}

static void the_studio_shines_where_nothing_else_does(void **state) {
    (void)state;
    const environment_options none = ENVIRONMENT_DEFAULTS;
    scene world = lit_scene();
    environment e;
    base_error error;
    assert_string_equal(environment_choose(&none, &world).name, "none");
    world.light_count = 0;
    assert_string_equal(environment_choose(&none, &world).name, "studio");
    world.lights_chosen = true;
    assert_string_equal(environment_choose(&none, &world).name, "none");
    assert_true(environment_open(&(environment_options) { .name = "studio", .strength = 1 }, &world,
                                 &e, &error));
    assert_true(environment_shines(&e) && environment_exposure(&e, 0) > 0);
    assert_true(environment_exposure(&e, 1) <= 0);
    /* White paper that faces up is bright but not overexposed. */
    assert_true(environment_project(&e, 3, &error));
    const lmp_rgb paper = lmp_probe_irradiance(3, e.sh, (lmp_vec3) { 0, 1, 0 });
    printf("white paper that faces up: %.3f\n", (double)paper.g / M_PI);
    assert_true(paper.g > 1.5f && paper.g < 5);
    CHECK_WITHIN(fabs((double)(paper.g / STUDIO_IRRADIANCE) - 1), 0.01);
    environment_free(&e);
}

/* Makes a floor under suns that give as much light as one of irradiance 5, 10, 15. */
static scene sunny_scene(bool cap, int count) {
    static scene_light suns[3];
    scene world = glowing_scene(1, 0);
    for (int i = 0; i < count; i++) {
        const lmp_rgb part = { 5 / (float)count, 10 / (float)count, 15 / (float)count };
        const float width = cap ? PI * 0.25f : 1; /* pi sin² of 30 degrees */
        suns[i].emitter = (lmp_light) { .kind = cap ? LMP_LIGHT_CAP : LMP_LIGHT_DIRECTIONAL,
                                        .direction = { 0.6f, 0.8f, 0 },
                                        .angle = cap ? PI / 6 : 0 };
        *(cap ? &suns[i].emitter.radiance : &suns[i].emitter.irradiance) =
            (lmp_rgb) { part.r / width, part.g / width, part.b / width };
    }
    suns[count].emitter = world.lights[0].emitter; /* a lamp, which does not count yet */
    world.lights = suns;
    world.light_count = (size_t)count;
    return world;
}

static void the_studio_is_the_sky_of_lone_suns(void **state) {
    (void)state;
    environment plain = { .bands = 0 };
    base_error plain_error;
    assert_true(environment_make_studio(&plain, &plain_error));
    for (int k = 0; k < 6; k++) {
        const scene world = sunny_scene(k & 1, 1 + (k > 1));
        const environment_options options = { .strength = k > 3 ? 3 : 1 };
        environment e;
        base_error error;
        assert_string_equal(environment_choose(&options, &world).name, "studio");
        assert_true(environment_open(&options, &world, &e, &error));
        assert_true(environment_project(&e, 3, &error));
        const lmp_rgb ground = lmp_probe_irradiance(3, e.sh, (lmp_vec3) { 0, 1, 0 });
        CHECK_WITHIN(fabs((double)(ground.g / options.strength) - 0.2 * 10), 0.05);
        /* What is seen of it is paper that the suns light as well. */
        const int middle = 3 * (e.backdrop.height / 3 * e.backdrop.width + e.backdrop.width / 2);
        const float lit = (0.2f * options.strength + 1) * 10 / STUDIO_IRRADIANCE;
        CHECK_WITHIN(fabs((double)(e.backdrop.rgb[middle] / plain.backdrop.rgb[middle] / lit) - 1),
                     1e-4);
        /* The exposure is that of what is seen, also when the suns have been removed. */
        assert_true(environment_exposure(&e, world.light_count) <= 0 &&
                    environment_exposure(&e, 0) <= 0);
        environment_free(&e);
    }
    environment_free(&plain);
    scene blinding = sunny_scene(false, 1);
    blinding.lights[0].emitter.irradiance.r = 1e18f;
    const environment_options none = ENVIRONMENT_DEFAULTS;
    CHECK_WITHIN((double)environment_choose(&none, &blinding).strength, ENVIRONMENT_STRENGTH_MAX);
}

static void suns_that_are_not_alone_have_no_sky(void **state) {
    (void)state;
    const environment_options options = ENVIRONMENT_DEFAULTS;
    scene world = sunny_scene(false, 2);
    world.light_count = 3; /* a lamp */
    assert_string_equal(environment_choose(&options, &world).name, "none");
    world.lights[2].hidden = 1; /* a mesh that glows with radiance 1 gives at most 3.1, the sky 2 */
    assert_string_equal(environment_choose(&options, &world).name, "none");
    world.lights[2].emitter.radiance = (lmp_rgb) { 0.6f, 0.6f, 0.6f };
    assert_string_equal(environment_choose(&options, &world).name, "studio");
    world.light_count = 2;
    world.lights_chosen = true;
    assert_string_equal(environment_choose(&options, &world).name, "none");
    world.lights_chosen = false;
    for (int i = 0; i < 2; i++)
        world.lights[i].emitter.irradiance = (lmp_rgb) { 0, 0, 0 };
    assert_string_equal(environment_choose(&options, &world).name, "none");
    /* What is chosen stays as it is. */
    const char *const names[] = { "none", "studio", "sky.exr" };
    world = sunny_scene(false, 1);
    for (size_t i = 0; i < 3; i++) {
        const environment_options chosen =
            environment_choose(&(environment_options) { .name = names[i], .strength = 1 }, &world);
        assert_string_equal(chosen.name, names[i]);
        assert_true(chosen.strength == 1);
    }
}

/* --- suns ------------------------------------------------------------------------------------- */

enum { SKY_WIDTH = 256, SKY_HEIGHT = 128 };

/* Returns the cosine between a pixel's direction and another one, in the image's own frame. */
static double sky_cosine(int pixel, const double w[3]) {
    const double theta = M_PI * (pixel / SKY_WIDTH + 0.5) / SKY_HEIGHT;
    const double phi = 2 * M_PI * ((pixel % SKY_WIDTH + 0.5) / SKY_WIDTH - 0.5);
    return sin(theta) * (cos(phi) * w[0] + sin(phi) * w[2]) + cos(theta) * w[1];
}

/* Makes a blue sky of radiance 0.2, 0.4, 0.8 with a disc around a direction. */
static image sky_with_disc(const double w[3], double angle, float radiance) {
    image pixels = filled(SKY_WIDTH, SKY_HEIGHT, 0.2f);
    for (int i = 0; i < SKY_WIDTH * SKY_HEIGHT; i++)
        for (int c = 0; c < 3 && sky_cosine(i, w) >= cos(angle); c++)
            pixels.rgb[3 * i + c] = radiance * (float)(3 - c);
    return pixels;
}

/* Returns the irradiance, in red, of a surface that faces the direction. */
static double irradiance(const image *pixels, const double w[3]) {
    double sum = 0;
    for (int i = 0; i < SKY_WIDTH * SKY_HEIGHT; i++) {
        const int row = i / SKY_WIDTH;
        const double solid = (cos(M_PI * row / SKY_HEIGHT) - cos(M_PI * (row + 1) / SKY_HEIGHT)) *
                             2 * M_PI / SKY_WIDTH;
        sum += solid * fmax(sky_cosine(i, w), 0) * (double)pixels->rgb[3 * i];
    }
    return sum;
}

static void a_sun_in_an_image_becomes_a_cap(void **state) {
    (void)state;
    const double directions[][3] = { { 0.48, 0.6, 0.64 }, { -0.8, 0.6, 1e-3 }, { 0, -1, 0 } };
    for (int i = 0; i < 3; i++) {
        const double *w = directions[i], angle = 0.06, turn = 40.0 * i * M_PI / 180;
        /* Counter-clockwise as seen from above. */
        const double rotated[3] = { w[0] * cos(turn) + w[2] * sin(turn), w[1],
                                    w[2] * cos(turn) - w[0] * sin(turn) };
        image pixels = sky_with_disc(w, angle, 1e4f);
        environment e;
        base_error error;
        assert_true(opens(&pixels, 40.0f * (float)i, 1, &e, &error));
        const double before = irradiance(&e.light, w);
        assert_true(environment_extract_suns(&e, &error));
        assert_int_equal(e.sun_count, 1);
        const lmp_light *sun = &e.suns[0].emitter;
        const lmp_vec3 d = sun->direction;
        assert_int_equal(sun->kind, LMP_LIGHT_CAP);
        CHECK_WITHIN(
            1 - ((double)d.x * rotated[0] + (double)d.y * rotated[1] + (double)d.z * rotated[2]),
            1e-4);
        CHECK_WITHIN(fabs((double)sun->angle / angle - 1), 0.25); /* pixels are 0.025 wide */
        const double after = irradiance(&e.light, w) +
                             M_PI * (double)sun->radiance.r * pow(sin((double)sun->angle), 2);
        CHECK_WITHIN(fabs(after / before - 1), 0.005);
        /* The sky behind the sun continues its surroundings; what is seen keeps the sun. */
        for (int k = 0; k < 3 * SKY_WIDTH * SKY_HEIGHT; k++)
            assert_true(e.light.rgb[k] < 0.9f);
        const lmp_rgb seen = environment_seen(&e, (float[]) { d.x, d.y, d.z });
        CHECK_WITHIN(fabs((double)seen.r / 3e4 - 1), 1e-3); /* in 16 bits */
        environment_free(&e);
        image_free(&pixels);
    }
}

/* White paper by ten bands, in every direction, agrees with quadrature of the whole image: on the
 * side away from a sun of 1e5 only the sky lights it. */
static void the_side_away_from_a_sun_is_as_dark_as_it_is(void **state) {
    (void)state;
    const double w[3] = { 0.48, 0.6, 0.64 };
    const lmp_material paper = { .diffuse = { 1, 1, 1 } };
    const lmp_shade_settings settings = { .bands = 10, .window = LMP_WINDOW_HANNING };
    image pixels = sky_with_disc(w, 0.06, 1e5f / 3);
    environment e;
    base_error error;
    assert_true(opens(&pixels, 0, 1, &e, &error));
    assert_true(environment_extract_suns(&e, &error) && environment_project(&e, 10, &error));
    const lmp_environment sky = { e.sh, e.bands };
    for (int i = 0; i < 100; i++) {
        const lmp_vec3 n = check_random_direction();
        const double normal[3] = { (double)n.x, (double)n.y, (double)n.z };
        const double expected = irradiance(&pixels, normal) / M_PI;
        const lmp_surface surface = { .normal = n, .view = n };
        const double found =
            (double)(lmp_shade(&settings, &paper, &surface, &e.suns[0].emitter, 1).r +
                     lmp_shade_environment(&settings, &paper, &surface, &sky).r);
        CHECK_WITHIN(fabs(found / expected - 1), 0.05);
    }
    environment_free(&e);
    image_free(&pixels);
}

/* As many suns are found as there are; none in a sky, a wide window or stars that give little. */
static void what_is_no_sun_stays_in_the_image(void **state) {
    (void)state;
    static const struct {
        double angle;
        float radiance;
    } discs[] = { { 0, 0 }, { 0.35, 1e4f }, { 0.06, 2 }, { 0.02, 20 } };
    for (int i = 0; i < 4; i++) {
        const double w[3] = { 0.48, 0.6, 0.64 };
        image pixels = sky_with_disc(w, discs[i].angle, discs[i].radiance);
        environment e;
        base_error error;
        assert_true(opens(&pixels, 0, 1, &e, &error));
        assert_true(environment_extract_suns(&e, &error));
        assert_int_equal(e.sun_count, 0);
        for (int k = 0; k < 3 * SKY_WIDTH * SKY_HEIGHT; k++)
            assert_true(fabsf(e.light.rgb[k] - pixels.rgb[k]) <= 1e-3f * pixels.rgb[k]);
        environment_free(&e);
        image_free(&pixels);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_even_image_is_an_even_light),
        cmocka_unit_test(directions_and_rotations_are_as_documented),
        cmocka_unit_test(crosses_are_unfolded),
        cmocka_unit_test(a_large_image_has_the_coefficients_of_all_its_pixels),
        cmocka_unit_test(what_is_no_environment_is_refused),
        cmocka_unit_test(the_strength_scales_what_shines_and_what_is_seen),
        cmocka_unit_test(the_studio_shines_where_nothing_else_does),
        cmocka_unit_test(the_studio_shines_where_what_glows_lights_little),
        cmocka_unit_test(the_studio_is_the_sky_of_lone_suns),
        cmocka_unit_test(suns_that_are_not_alone_have_no_sky),
        cmocka_unit_test(a_sun_in_an_image_becomes_a_cap),
        cmocka_unit_test(the_side_away_from_a_sun_is_as_dark_as_it_is),
        cmocka_unit_test(what_is_no_sun_stays_in_the_image),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
