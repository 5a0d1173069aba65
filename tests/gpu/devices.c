/* SPDX-License-Identifier: MIT */
/* The same image from both shading devices and every method, in 8 bits, under lights of every kind.
 */
#include "app/render/renderer/override.h"
#include "app/render/shade.h"
#include "app/render/shade_field.h"
#include "app/scene/bake.h"
#include "tests/gpu/device.h"
#include "tests/oracle/kinds.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 192, HEIGHT = 108, PIXELS = WIDTH * HEIGHT };

static unsigned char first[3 * PIXELS], second[3 * PIXELS];
static float exposure;

static void read_pixels(gpu_renderer *renderer, unsigned char *rgb8) {
    base_error error = { "" };
    expect(gpu_read_rgb8(renderer, &(image_display) { .exposure = exposure }, rgb8, NULL, &error),
           &error);
}

static void draw(gpu_renderer *renderer, const render_frame *frame, unsigned char *rgb8) {
    base_error error = { "" };
    expect(gpu_render(renderer, frame, NULL, &error), &error);
    read_pixels(renderer, rgb8);
}

/* Draws the first image, and sets the exposure that the program would choose. */
static void draw_first(gpu_renderer *renderer, const render_frame *frame) {
    image pixels = render_image(renderer, frame);
    exposure = image_auto_exposure(&pixels);
    image_free(&pixels);
    read_pixels(renderer, first);
}

/* Counts the pixels of which some channel differs by more than `levels`. */
static int beyond(int levels) {
    int count = 0;
    for (size_t i = 0; i < PIXELS; i++) {
        int worst = 0;
        for (size_t k = 0; k < 3; k++) {
            const int d = abs(first[3 * i + k] - second[3 * i + k]);
            worst = d > worst ? d : worst;
        }
        count += worst > levels;
    }
    return count;
}

typedef struct fixture {
    scene world;
    gpu_renderer *renderer;
    render_frame frame;
} fixture;

static void open_fixture(fixture *s, const char *name) {
    base_error error = { "" };
    expect(scene_load(name, &(scene_options) { .no_cache = true }, &s->world, &error), &error);
    expect(scene_apply_lights(&s->world, &(scene_lights_options) { .random_count = 20, .seed = 7 },
                              &error),
           &error);
    stand_within(&s->world, 0);
    for (int i = 0; i < KINDS; i++)
        s->world.lights[s->world.light_count++].emitter = one_of_each_kind[i];
    s->renderer = open_renderer(&s->world);
    s->frame = frame_of(&s->world, WIDTH, HEIGHT);
    s->frame.bands = usual_bands();
}

static void close_fixture(fixture *s) {
    gpu_renderer_destroy(s->renderer);
    scene_free(&s->world);
}

/* Both devices draw the frame by a method, within one level of 255. */
static void check_method(fixture *s, method_kind method) {
    s->frame.method = method;
    s->frame.cpu_shader = NULL;
    draw_first(s->renderer, &s->frame);
    s->frame.cpu_shader = shade_frame;
    draw(s->renderer, &s->frame, second);
    assert_int_equal(beyond(1), 0);
}

static shade_field *attach_field(fixture *s) {
    base_error error = { "" };
    const shade_field_options options = { .grid = { 30, 20, 30 },
                                          .grid_given = true,
                                          .error = SHADE_FIELD_ERROR };
    shade_field *field = shade_field_create(&s->world, &options, s->frame.bands, &error);
    expect(field != NULL, &error);
    shade_field_attach(field, &s->frame);
    return field;
}

static void check_every_method(fixture *s) {
    shade_field *field = attach_field(s);
    for (int m = 0; m < METHODS; m++)
        if (method_table[m].bands_max[DEVICE_GPU] > 0)
            check_method(s, (method_kind)m);
    s->frame.method = METHOD_ZONAL;
    shade_field_attach(NULL, &s->frame);
    shade_field_destroy(field);
}

static lmp_preintegrated_lobe *lobe_of(const render_frame *frame) {
    lmp_preintegrated_lobe *lobe;
    const lmp_preintegrated_lobe_desc desc = { .bands = frame->bands,
                                               .window = frame->window,
                                               .error = BAKE_LOBES_ERROR };
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
    return lobe;
}

static void both_devices_draw_the_same_image(void **state) {
    (void)state;
    const char *const scenes[] = { "builtin:atrium", "builtin:balls" };
    for (int i = 0; i < 2; i++) {
        fixture s;
        open_fixture(&s, scenes[i]);
        lmp_preintegrated_lobe *lobe = lobe_of(&s.frame);
        s.frame.lobes = lobe;
        check_every_method(&s);
        lmp_preintegrated_lobe_destroy(lobe);
        close_fixture(&s);
    }
}

static void parallel_rays_are_drawn_alike(void **state) {
    (void)state;
    fixture f;
    open_fixture(&f, "builtin:balls");
    lmp_preintegrated_lobe *lobe = lobe_of(&f.frame);
    f.frame.lobes = lobe;
    f.frame.camera.height = 3;
    f.frame.samples = 2;
    check_every_method(&f);
    lmp_preintegrated_lobe_destroy(lobe);
    close_fixture(&f);
}

/* Makes ambient light without any symmetry. */
static void open_sky(environment *sky) {
    base_error error;
    *sky = (environment) { .azimuth = 0.4f };
    expect(image_create(&sky->light, 32, 16, &error), &error);
    for (int i = 0; i < 3 * 32 * 16; i++)
        sky->light.rgb[i] = (float)(i * 7919 % 101) / 25;
    sky->backdrop = sky->light;
    expect(environment_project(sky, LMP_SHADE_BANDS_DEFAULT, &error), &error);
}

/* The environment lights surfaces and is seen past them, with other lights and without. */
static void an_environment_is_drawn_alike(void **state) {
    (void)state;
    fixture s;
    environment e;
    open_fixture(&s, "builtin:ball");
    open_sky(&e);
    gpu_set_environment(s.renderer, &e);
    lmp_preintegrated_lobe *lobes = lobe_of(&s.frame);
    s.frame.lobes = lobes;
    for (int pass = 0; pass < 2; pass++, s.frame.light_count = 0)
        check_every_method(&s);
    /* A camera that looks up sees only the backdrop. */
    memcpy(s.frame.camera.target, s.frame.camera.eye, sizeof s.frame.camera.eye);
    s.frame.camera.target[0] += 0.1f;
    s.frame.camera.target[1] += 1;
    for (int hidden = 0; hidden < 2; hidden++) {
        s.frame.hide_backdrop = hidden;
        image sky = render_image(s.renderer, &s.frame);
        assert_int_equal(sky.rgb[3 * (PIXELS / 2 + WIDTH / 2)] > 0, !hidden);
        image_free(&sky);
    }
    lmp_preintegrated_lobe_destroy(lobes);
    close_fixture(&s);
    environment_free(&e);
}

static void check_preintegrated(fixture *s) {
    s->frame.method = METHOD_ZONAL;
    draw_first(s->renderer, &s->frame);
    lmp_preintegrated_lobe *lobe = lobe_of(&s->frame);
    s->frame.lobes = lobe;
    s->frame.method = METHOD_PREINTEGRATED;
    draw(s->renderer, &s->frame, second);
    print_message("%d bands, window %d: %d pixels of %d differ by more than a level\n",
                  s->frame.bands, (int)s->frame.window, beyond(1), PIXELS);
    assert_true(beyond(1) <= PIXELS / 1000);
    assert_int_equal(beyond(2), 0);
    lmp_preintegrated_lobe_destroy(lobe);
}

static void preintegrated_images_are_those_of_sums(const int bands[3]) {
    const char *const scenes[] = { "builtin:atrium", "builtin:balls" };
    for (int i = 0; i < 2; i++) {
        fixture s;
        open_fixture(&s, scenes[i]);
        for (int b = 0; b < 3 && bands[b]; b++) {
            s.frame.bands = bands[b];
            s.frame.window = LMP_WINDOW_NONE;
            check_preintegrated(&s);
            s.frame.window = LMP_WINDOW_HANNING;
            check_preintegrated(&s);
        }
        close_fixture(&s);
    }
}

static void preintegrated_images_of_few_bands_are_those_of_sums(void **state) {
    (void)state;
    preintegrated_images_are_those_of_sums((const int[3]) { 5, 8, 12 });
}

static void preintegrated_images_of_many_bands_are_those_of_sums(void **state) {
    (void)state;
    preintegrated_images_are_those_of_sums((const int[3]) { 16, 20 });
}

/* The materials are tabulated; the gold is read from its lobe, the last one from its bands. */
static void tabulated_materials_are_drawn_alike_by_sums_and_by_tables(void **state) {
    (void)state;
    fixture s;
    open_fixture(&s, "builtin:ball");
    s.frame.bands = 10;
    s.frame.window = LMP_WINDOW_HANNING;
    lmp_brdf_table *tables[2];
    lmp_preintegrated_brdf *brdfs[2] = { NULL, NULL };
    const char *const names[2] = { "gold-metallic-paint", "red-fabric" };
    for (int i = 0; i < 2; i++) {
        lmp_sgd sgd;
        lmp_brdf *brdf;
        const lmp_brdf_table_desc desc = { .bands = 10,
                                           .window = LMP_WINDOW_HANNING,
                                           .rings_max = 64 };
        assert_int_equal(lmp_brdf_find_sgd(names[i], &sgd), LMP_OK);
        assert_int_equal(lmp_brdf_create_sgd(NULL, &sgd, &brdf), LMP_OK);
        assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &tables[i]), LMP_OK);
        lmp_brdf_destroy(brdf);
        assert_int_equal(lmp_preintegrated_brdf_create(NULL, NULL, tables[i], &brdfs[i]), LMP_OK);
    }
    int uses[8] = { -1, 1, 0 };
    base_error error = { "" };
    expect(gpu_set_tables(s.renderer, (const lmp_brdf_table *const *)tables, 2, uses, &error),
           &error);
    s.frame.method = METHOD_ZONAL;
    draw_first(s.renderer, &s.frame);
    lmp_preintegrated_lobe *lobes = lobe_of(&s.frame);
    s.frame.lobes = lobes;
    s.frame.method = METHOD_PREINTEGRATED;
    for (int pass = 0; pass < 3; pass++) {
        const lmp_preintegrated_brdf *given[2] = { brdfs[0], pass == 2 ? NULL : brdfs[1] };
        gpu_set_preintegrated_brdfs(s.renderer, given);
        s.frame.cpu_shader = pass == 1 ? shade_frame : NULL;
        draw(s.renderer, &s.frame, second);
        assert_true(beyond(1) <= PIXELS / 1000);
        assert_int_equal(beyond(2), 0);
    }
    /* Under a sky both are summed by their bands, though one alone has been uploaded for that. */
    environment sky;
    open_sky(&sky);
    gpu_set_environment(s.renderer, &sky);
    s.frame.cpu_shader = shade_frame;
    draw_first(s.renderer, &s.frame);
    s.frame.cpu_shader = NULL;
    draw(s.renderer, &s.frame, second);
    assert_true(beyond(1) <= PIXELS / 1000);
    assert_int_equal(beyond(2), 0);
    environment_free(&sky);
    lmp_preintegrated_lobe_destroy(lobes);
    close_fixture(&s);
    for (int i = 0; i < 2; i++) {
        lmp_brdf_table_destroy(tables[i]);
        lmp_preintegrated_brdf_destroy(brdfs[i]);
    }
}

/* Cloth of every roughness, some of it under a coat. */
enum { DRESSED = 64 };
static void dress(scene *world, scene_material *all) {
    const size_t count = world->material_count;
    assert_true(count <= DRESSED);
    memcpy(all, world->materials, count * sizeof *all);
    for (size_t i = 0; i < count; i++) {
        const float part = (float)i / (float)count, color[3] = { 1, 0.5f, part };
        memcpy(all[i].sheen_color, color, sizeof color);
        all[i].sheen_roughness = part;
        all[i].coat = i % 3 == 0 ? 0.5f : 0;
    }
    world->materials = all;
}

static void open_dressed(fixture *s, scene_material *materials) {
    open_fixture(s, "builtin:balls");
    gpu_renderer_destroy(s->renderer);
    dress(&s->world, materials);
    s->renderer = open_renderer(&s->world);
}

/* Gives the renderer tables of sheen of so many bands, which `tables` keeps. */
static void bake_sheen(fixture *s, int bands, override_set *tables) {
    base_error error = { "" };
    override_free(tables);
    expect(override_bake_sheen(tables, &s->world, bands, s->frame.window, &error), &error);
    override_set lent = *tables; /* the renderer keeps the tables, not the list of them */
    expect(override_apply(&lent, &s->world, &(any_renderer) { .gl = s->renderer }, &error), &error);
}

/* Passes: 0 under lights; 1 with more bands than sheen has, as from 21 on; 2 under a sky. */
static void sheen_is_drawn_alike(int first_pass, int last_pass) {
    fixture s;
    environment sky;
    override_set tables = { .count = 0 };
    scene_material materials[DRESSED];
    open_dressed(&s, materials);
    open_sky(&sky);
    const int sheen_bands[] = { 6, 4, 6 };
    s.frame.bands = 6;
    for (int pass = first_pass; pass <= last_pass; pass++) {
        s.frame.window = pass == 0 ? LMP_WINDOW_HANNING : LMP_WINDOW_NONE;
        if (pass == 2)
            gpu_set_environment(s.renderer, &sky);
        lmp_preintegrated_lobe *lobes = lobe_of(&s.frame);
        s.frame.lobes = lobes;
        bake_sheen(&s, sheen_bands[pass], &tables);
        if (pass == 0)
            check_every_method(&s);
        else
            check_method(&s, pass == 1 ? METHOD_PREINTEGRATED : METHOD_ZONAL);
        lmp_preintegrated_lobe_destroy(lobes);
    }
    close_fixture(&s);
    override_free(&tables);
    environment_free(&sky);
}

static void sheen_is_drawn_alike_under_lights(void **state) {
    (void)state;
    sheen_is_drawn_alike(0, 0);
}

static void sheen_is_drawn_alike_by_more_bands_and_under_a_sky(void **state) {
    (void)state;
    sheen_is_drawn_alike(1, 2);
}

/* The lobes of GGX, a sky and a field are read from storage blocks on hardware, and fetched from
 * textures on software; any device can do both. */
static void arrays_are_read_alike_in_both_forms(void **state) {
    (void)state;
    const bool software = device.software;
    for (int form = 0; form < 2; form++) {
        fixture s;
        environment sky;
        device.software = form;
        open_fixture(&s, "builtin:ball");
        open_sky(&sky);
        gpu_set_environment(s.renderer, &sky);
        s.frame.bands = 2;
        s.frame.method = METHOD_FIELD;
        shade_field *field = attach_field(&s);
        if (form == 0)
            draw_first(s.renderer, &s.frame);
        else
            draw(s.renderer, &s.frame, second);
        shade_field_destroy(field);
        close_fixture(&s);
        environment_free(&sky);
    }
    device.software = software;
    assert_int_equal(beyond(0), 0);
}

static void what_is_timed_for_comparison_draws_the_same_image(void **state) {
    (void)state;
    fixture s;
    open_fixture(&s, "builtin:atrium");
    s.frame.method = METHOD_COEFFICIENTS;
    draw_first(s.renderer, &s.frame);
    s.frame.method = METHOD_PAPER;
    draw(s.renderer, &s.frame, second);
    assert_int_equal(beyond(1), 0);
    const int bands = s.frame.bands;
    s.frame.bands = 1; /* one band has no table */
    s.frame.method = METHOD_COEFFICIENTS;
    draw_first(s.renderer, &s.frame);
    for (int m = 0; m < 2; m++) {
        s.frame.method = m == 0 ? METHOD_PAPER : METHOD_TABULATED_Z;
        draw(s.renderer, &s.frame, second);
        assert_int_equal(beyond(1), 0);
    }
    s.frame.bands = bands;
    /* the tabulation loses digits of far lights, and has no Diracs */
    s.frame.light_count -= KINDS;
    s.frame.method = METHOD_COEFFICIENTS;
    draw_first(s.renderer, &s.frame);
    s.frame.method = METHOD_TABULATED_Z;
    draw(s.renderer, &s.frame, second);
    assert_true(beyond(1) <= PIXELS / 500);
    /* A light around part of the scene's surfaces, whose cap is more than half of all directions.
     */
    const scene_light around = {
        .emitter = { .position = { 0, 1, 0 }, .radius = 4, .radiance = { 0.3f, 0.2f, 0.1f } },
        .hidden = 1
    };
    s.frame.lights = &around;
    s.frame.light_count = 1;
    s.frame.method = METHOD_COEFFICIENTS;
    draw_first(s.renderer, &s.frame);
    s.frame.method = METHOD_TABULATED_Z;
    draw(s.renderer, &s.frame, second);
    assert_true(beyond(1) <= PIXELS / 500);
    close_fixture(&s);
}

/* Toward grazing views the errors of five lobes' tables add up, each relative to a high peak. */
static void assert_narrow_lobes_alike(void) {
    assert_true(beyond(1) <= PIXELS / 1000);
    assert_true(beyond(2) <= PIXELS / 10000);
    assert_int_equal(beyond(4), 0);
}

static void a_hundred_bands_are_drawn_alike_by_sums_and_by_tables(void **state) {
    (void)state;
    fixture s;
    open_fixture(&s, "builtin:balls");
    s.frame.bands = 100;
    s.frame.cpu_shader = shade_frame;
    draw_first(s.renderer, &s.frame);
    lmp_preintegrated_lobe *lobe = lobe_of(&s.frame);
    s.frame.lobes = lobe;
    s.frame.method = METHOD_PREINTEGRATED;
    draw(s.renderer, &s.frame, second);
    assert_narrow_lobes_alike();
    s.frame.cpu_shader = NULL;
    draw(s.renderer, &s.frame, second);
    assert_narrow_lobes_alike();
    lmp_preintegrated_lobe_destroy(lobe);
    close_fixture(&s);
}

/* Runs all groups or a named one: ctest runs each beside others, because drivers compile for long.
 */
int main(int count, char **arguments) {
    const struct CMUnitTest images[] = {
        cmocka_unit_test(both_devices_draw_the_same_image),
        cmocka_unit_test(parallel_rays_are_drawn_alike),
    };
    const struct CMUnitTest environments[] = {
        cmocka_unit_test(an_environment_is_drawn_alike),
        cmocka_unit_test(arrays_are_read_alike_in_both_forms),
    };
    const struct CMUnitTest few[] = {
        cmocka_unit_test(preintegrated_images_of_few_bands_are_those_of_sums),
        cmocka_unit_test(a_hundred_bands_are_drawn_alike_by_sums_and_by_tables),
    };
    const struct CMUnitTest many[] = {
        cmocka_unit_test(preintegrated_images_of_many_bands_are_those_of_sums),
    };
    const struct CMUnitTest tables[] = {
        cmocka_unit_test(tabulated_materials_are_drawn_alike_by_sums_and_by_tables),
        cmocka_unit_test(what_is_timed_for_comparison_draws_the_same_image),
    };
    const struct CMUnitTest sheen_lights[] = {
        cmocka_unit_test(sheen_is_drawn_alike_under_lights),
    };
    const struct CMUnitTest sheen_sky[] = {
        cmocka_unit_test(sheen_is_drawn_alike_by_more_bands_and_under_a_sky),
    };
    int ran = 0, failed = 0;
    RUN_GROUP(images);
    RUN_GROUP(environments);
    RUN_GROUP_AS(few, "bands.few");
    RUN_GROUP_AS(many, "bands.many");
    RUN_GROUP(tables);
    RUN_GROUP_AS(sheen_lights, "sheen.lights");
    RUN_GROUP_AS(sheen_sky, "sheen.sky");
    return ran > 0 ? failed : 1;
}
