/* SPDX-License-Identifier: MIT */
/* Which lights make what is under the pointer, against images with one light each. */
#include "app/render/renderer/shadows.h"
#include "app/render/shade_field.h"
#include "app/view/lobes.h"
#include "app/view/shares.h"
#include "app/view/surroundings.h"

#include "app/base/file_json.h"
#include "app/scene/vector.h"
#include "tests/program/load.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 20, HEIGHT = 15, PIXELS = WIDTH * HEIGHT };

static scene world;
static view_tree *tree;
static view_settings settings;
static view_compositor *compositor;

/* Lights of every kind over the balls, at different distances and of different colors. */
static void put_lights(void) {
    settings.light_count = 0;
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++) {
        lmp_light light = scene_light_model((lmp_light_kind)kind, 0.5f, 2);
        const float angle = 2.4f * (float)kind;
        light.position = vec(2 * cosf(angle), 2.5f, 2 * sinf(angle) + 1);
        light.radiance.g *= 0.3f + 0.1f * (float)kind;
        light.radiance.b *= 1 - 0.1f * (float)kind;
        settings.lights[settings.light_count++] = (scene_light) { .emitter = light, .hidden = 1 };
    }
}

/* --- images ----------------------------------------------------------------------------------- */

/* A renderer of its own, which draws the settings with some of the lights. */
static struct {
    render_device device;
    any_renderer *renderer;
    shade_field *field;
    view_surroundings skies[2]; /* none, and that of the settings */
    shadow *shadows[2];         /* under each */
} own;
static view_lobes lobes;

static void open_sky(int sky, const char *name) {
    static const shadow_settings many = { .rays = 1024, .raw = true, .apart = true };
    static view_settings under;
    base_error error = { "" };
    memcpy(&under, &settings, sizeof settings);
    strcpy(under.environment.name, name);
    assert_true(view_surroundings_open(&own.skies[sky], &under, &world, &error));
    environment *around = &own.skies[sky].around;
    assert_true(environment_project(around, settings.shading[0].bands, &error));
    own.shadows[sky] = render_device_shadow(&own.device, around, &many, &error);
    assert_non_null(own.shadows[sky]);
}

static void open_renderer(void) {
    static const shade_field_options options = { .error = SHADE_FIELD_ERROR };
    const view_shading *shading = &settings.shading[0];
    base_error error = { "" };
    memset(&own, 0, sizeof own);
    assert_true(render_device_open_cpu(&world, view_tree_wait(tree), &own.device, &error));
    own.renderer = renderer_create(&own.device, &error);
    assert_non_null(own.renderer);
    open_sky(0, "none");
    open_sky(1, settings.environment.name);
    if (shading->method == METHOD_FIELD) {
        own.field = shade_field_create(&world, &options, shading->bands, &error);
        assert_non_null(own.field);
    }
}

static void close_renderer(void) {
    for (int sky = 0; sky < 2; sky++) {
        shadow_destroy(own.shadows[sky]);
        environment_free(&own.skies[sky].around);
    }
    renderer_destroy(own.renderer);
    shade_field_destroy(own.field);
    render_device_close(&own.device);
}

static void draw(const scene_light *lights, size_t count, int sky, bool shadows, image *drawn) {
    base_error error = { "" };
    const view_shading *shading = &settings.shading[0];
    render_frame frame = { .width = WIDTH,
                           .height = HEIGHT,
                           .camera = settings.camera,
                           .method = shading->method,
                           .bands = shading->bands,
                           .window = shading->window,
                           .lights = lights,
                           .light_count = count,
                           .samples = 1 };
    renderer_set_environment(own.renderer, &own.skies[sky].around);
    shade_field_attach(own.field, &frame);
    shade_field_forget(own.field);
    if (shading->method == METHOD_PREINTEGRATED)
        assert_non_null(frame.lobes = view_lobes_get(&lobes, shading, &error));
    if (shadows)
        frame.shadow = shadow_pass(own.shadows[sky]);
    assert_true(renderer_draw(own.renderer, &frame, NULL, &error));
    assert_true(renderer_read_image(own.renderer, drawn, &error));
}

static void open_world(const char *name, const char *around, int method) {
    base_error error = { "" };
    memset(&settings, 0, sizeof settings);
    world = load(name);
    tree = view_tree_begin(&world, &error);
    assert_non_null(tree);
    strcpy(settings.scene, name);
    strcpy(settings.environment.name, around);
    settings.environment.strength = 1;
    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.samples = 4;
    settings.exposure = 1;
    settings.camera = scene_default_camera(&world, (float)WIDTH / HEIGHT);
    settings.shading[0] = settings.shading[1] =
        (view_shading) { (method_kind)method, method == METHOD_FIELD ? 4 : 10, LMP_WINDOW_NONE };
    put_lights();
    compositor = view_compositor_create(NULL, &world, tree, NULL, &error);
    assert_non_null(compositor);
    open_renderer();
}

static void close_world(void) {
    close_renderer();
    view_compositor_destroy(compositor);
    view_tree_end(tree);
    scene_free(&world);
}

/* --- shares ----------------------------------------------------------------------------------- */

static float largest(const float *rgb) {
    return fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
}

static const char *kind_of(size_t light) {
    return scene_light_kinds[settings.lights[light].emitter.kind].name;
}

/* Finds what a source gives to a pixel; 0 if it is not listed. */
static const float *given(const view_shares *shares, int light, const char *name) {
    static const float none[3] = { 0, 0, 0 };
    for (size_t i = 0; i < shares->count; i++)
        if (shares->of[i].light == light && strcmp(shares->of[i].name, name) == 0)
            return &shares->of[i].radiance.r;
    return none;
}

static view_shares ask(int x, int y) {
    view_shares shares = { .count = 0 };
    base_error error = { "" };
    if (!view_shares_find(compositor, &settings, 0, x, y, &shares, &error))
        fail_msg("%s", error.text);
    return shares;
}

/* The shares are complete and in order, and sum to the image's pixel. Where all is clamped, they
 * sum to 0 within rounding. Returns how many there are. */
static size_t check_sum(const image *all, int x, int y) {
    view_shares shares = ask(x, y);
    const float *pixel = all->rgb + 3 * (y * WIDTH + x);
    double sum[3] = { 0 }, percent = 0, most = 0;
    for (size_t i = 0; i < shares.count; i++) {
        const float *part = &shares.of[i].radiance.r;
        most = fmax(most, (double)largest(part));
        for (int c = 0; c < 3; c++)
            sum[c] += (double)part[c];
        percent += shares.of[i].percent;
        assert_true(i == 0 || shares.of[i].percent <= shares.of[i - 1].percent);
    }
    const bool dark = largest(pixel) == 0;
    for (int c = 0; c < 3 && shares.count > 0; c++)
        CHECK_WITHIN(fabs(sum[c] - (double)pixel[c]),
                     1e-5 * (dark ? most : (double)largest(pixel)));
    if (shares.count > 0 && !dark)
        CHECK_WITHIN(fabs(percent - 100), 1e-3);
    const size_t count = shares.count;
    view_shares_free(&shares);
    return count;
}

static void shares_sum_to_the_pixel(void **unused) {
    (void)unused;
    static const char *const scenes[] = { "builtin:balls", "builtin:room" };
    for (int s = 0; s < 2; s++)
        for (int method = 0; method < METHODS; method++) {
            image all;
            size_t lit = 0;
            open_world(scenes[s], s ? "none" : "studio", method);
            draw(settings.lights, settings.light_count, 1, false, &all);
            for (int i = 0; i < check_count(40, PIXELS); i++) {
                const int at = i * 7919 % PIXELS;
                lit += check_sum(&all, at % WIDTH, at / WIDTH) > 5;
            }
            assert_true(lit > 10);
            image_free(&all);
            close_world();
        }
}

/* Compares the shares of a pixel with images of each light, and of the environment after them. */
static void compare_alone(int at, const image *alone, float brightest) {
    view_shares shares = ask(at % WIDTH, at / WIDTH);
    const size_t count = settings.light_count;
    for (size_t i = 0; i <= count && shares.count > 0; i++) {
        const float *mine =
            i < count ? given(&shares, (int)i, kind_of(i)) : given(&shares, -1, "environment");
        for (int c = 0; c < 3; c++)
            CHECK_WITHIN(fabs(fmax((double)mine[c], 0) - (double)alone[i].rgb[3 * at + c]),
                         1e-5 * (double)brightest);
    }
    view_shares_free(&shares);
}

/* Each share is what an image with this light alone shows, but for what that clamps. */
static void shares_are_what_each_light_gives_alone(void **unused) {
    (void)unused;
    for (int method = 0; method < METHODS; method++) {
        image all, alone[SCENE_LIGHT_KIND_COUNT + 1];
        open_world("builtin:balls", "studio", method);
        const size_t count = settings.light_count;
        draw(settings.lights, count, 1, false, &all);
        for (int shadows = 0; shadows < 2; shadows++) {
            settings.shadows = shadows;
            for (size_t i = 0; i < count; i++)
                draw(&settings.lights[i], 1, 0, shadows, &alone[i]);
            draw(NULL, 0, 1, shadows, &alone[count]);
            for (int k = 0; k < check_count(8, PIXELS); k++) {
                const int at = (k * 7919 + 300) % PIXELS;
                compare_alone(at, alone, largest(all.rgb + 3 * at));
            }
            for (size_t i = 0; i <= count; i++)
                image_free(&alone[i]);
        }
        image_free(&all);
        close_world();
    }
}

/* A lamp that is seen is all that is there, a glowing surface gives its emission, and elsewhere
 * there is nothing. */
static void what_shines_itself_is_named(void **unused) {
    (void)unused;
    char text[256];
    open_world("builtin:balls", "none", METHOD_ZONAL);
    settings.lights[0].hidden = 0;
    settings.lights[0].emitter.radius = 0.5f;
    const float *target = settings.camera.target, *eye = settings.camera.eye;
    settings.lights[0].emitter.position = vec_scale(vec_add(vec_load(target), vec_load(eye)), 0.5f);
    view_shares shares = ask(WIDTH / 2, HEIGHT / 2);
    assert_int_equal(shares.count, 1);
    assert_int_equal(shares.of[0].light, 0);
    view_shares_describe(&shares, text, sizeof text);
    assert_string_equal(text, "100 % light 0 (sphere)");
    view_shares_free(&shares);
    settings.camera.target[1] += 1000;
    shares = ask(WIDTH / 2, HEIGHT / 2);
    assert_int_equal(shares.count, 0);
    view_shares_describe(&shares, text, sizeof text);
    assert_non_null(strstr(text, "No light"));
    view_shares_free(&shares);
    close_world();
}

/* Light that bounces is one share, and what lights give directly stays the same. */
static void what_bounces_is_one_share(void **unused) {
    (void)unused;
    open_world("builtin:room", "none", METHOD_ZONAL);
    view_shares direct = ask(WIDTH / 2, HEIGHT - 3);
    settings.bounces = 2;
    view_shares all = ask(WIDTH / 2, HEIGHT - 3);
    assert_int_equal(all.count, direct.count + 1);
    for (int c = 0; c < 3; c++)
        assert_true(given(&all, -1, "bounces")[c] > 0);
    for (size_t i = 0; i < settings.light_count; i++)
        assert_memory_equal(given(&direct, (int)i, kind_of(i)), given(&all, (int)i, kind_of(i)),
                            sizeof(lmp_rgb));
    view_shares_free(&direct);
    view_shares_free(&all);
    close_world();
}

static void shares_are_written(void **unused) {
    (void)unused;
    char text[256];
    open_world("builtin:balls", "studio", METHOD_ZONAL);
    view_shares shares = ask(WIDTH / 2, HEIGHT / 2);
    assert_true(shares.count > 5);
    view_shares_describe(&shares, text, sizeof text);
    assert_non_null(strstr(text, "more"));
    assert_non_null(strstr(text, " % light "));
    json_t *root = view_shares_to_json(&shares), *rows = json_object_get(root, "of");
    assert_int_equal(json_array_size(rows), shares.count);
    for (size_t i = 0; i < shares.count; i++) {
        const json_t *row = json_array_get(rows, i);
        assert_string_equal(json_string_value(json_object_get(row, "kind")), shares.of[i].name);
        CHECK_WITHIN(fabs(json_real_value(json_object_get(row, "percent")) - shares.of[i].percent),
                     0);
        const json_t *light = json_object_get(row, "light");
        assert_int_equal(light ? json_integer_value(light) : -1, shares.of[i].light);
    }
    json_decref(root);
    view_shares_free(&shares);
    close_world();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_sum_to_the_pixel),
        cmocka_unit_test(shares_are_what_each_light_gives_alone),
        cmocka_unit_test(what_shines_itself_is_named),
        cmocka_unit_test(what_bounces_is_one_share),
        cmocka_unit_test(shares_are_written),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    view_lobes_free(&lobes);
    return failed;
}
