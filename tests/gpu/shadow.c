/* SPDX-License-Identifier: MIT */
/* Shadows by rays and a ratio, held to the ground truth. */
#include "tests/gpu/shadow.h"
#include "app/truth/reference.h"
#include "tests/oracle/kinds.h"

#include <omp.h>

/* --- the ground truth ------------------------------------------------------------------------- */

typedef struct ground_truth {
    image lit, lit_error, shadowed, shadowed_error;
} ground_truth;

static ground_truth find_truth(const stage *s, const environment *around) {
    ground_truth t;
    base_error error = { "" };
    reference_settings settings = {
        .width = WIDTH,
        .height = HEIGHT,
        .camera = s->frame.camera,
        .samples = check_count(256, 1024),
        .seed = 1,
        .environment = around,
    };
    expect(reference_render(&s->world, &settings, &t.lit, &t.lit_error, &error), &error);
    settings.shadows = true;
    expect(reference_render(&s->world, &settings, &t.shadowed, &t.shadowed_error, &error), &error);
    return t;
}

static void free_truth(ground_truth *t) {
    image_free(&t->lit);
    image_free(&t->lit_error);
    image_free(&t->shadowed);
    image_free(&t->shadowed_error);
}

/* Averages many seeds: the mean, and the variance of that mean, of each channel. */
static void average(stage *s, const environment *around, int seeds, double *mean,
                    double *variance) {
    memset(mean, 0, 3 * PIXELS * sizeof *mean);
    memset(variance, 0, 3 * PIXELS * sizeof *variance);
    for (int seed = 0; seed < seeds; seed++) {
        const shadow_settings settings = { .rays = 16, .seed = (uint32_t)seed, .raw = true };
        image pixels = draw_shadows(s, around, &settings);
        for (int i = 0; i < 3 * PIXELS; i++) {
            const double value = (double)pixels.rgb[i];
            mean[i] += value / seeds;
            variance[i] += value * value / seeds;
        }
        image_free(&pixels);
    }
    for (int i = 0; i < 3 * PIXELS; i++)
        variance[i] = fmax(variance[i] - mean[i] * mean[i], 0) / (seeds - 1);
}

/* Judges the image against the ground truth and returns how many pixels were judged: what is
 * hidden, within 3 standard errors and what 20 bands and lobes of GGX leave (`left`). Along edges
 * the rasterizer and a ray may show different surfaces: these differ without shadows, too. */
static int judge(stage *s, const environment *around, double left) {
    static double mean[3 * PIXELS], variance[3 * PIXELS];
    ground_truth t = find_truth(s, around);
    image lit = render_image(s->renderer, &s->frame);
    int judged = 0, wrong = 0;
    double hidden = 0;
    average(s, around, check_count(16, 64), mean, variance);
    for (int p = 0; p < PIXELS; p++) {
        bool edge = false, off = false;
        for (int i = 3 * p; i < 3 * p + 3; i++) {
            const double all = (double)lit.rgb[i], true_all = (double)t.lit.rgb[i];
            const double e = (double)t.lit_error.rgb[i], f = (double)t.shadowed_error.rgb[i];
            const double d = (all > 0 ? mean[i] / all * true_all : 0) - (double)t.shadowed.rgb[i];
            edge = edge || !(fabs(all - true_all) <= 5 * e + 0.02 * true_all);
            off = off || !(fabs(d) <= 3 * sqrt(f * f + variance[i]) + left * true_all);
            hidden += (all - mean[i]) / (3 * PIXELS);
        }
        judged += !edge;
        wrong += !edge && off;
    }
    print_message("%d of %d pixels differ, %d not judged\n", wrong, judged, PIXELS - judged);
    assert_true(hidden > 0);
    assert_in_range(wrong, 0, judged / 200);
    image_free(&lit);
    free_truth(&t);
    return judged;
}

static void check_against_truth(stage *s, const environment *around, double left) {
    assert_in_range(PIXELS - judge(s, around, left), 0, PIXELS / 25);
}

/* Over black, lobes of rough dielectrics err by some hundredths of the little that is reflected. */
static void check_over_black(stage *s, double left) {
    assert_in_range(PIXELS - judge(s, NULL, left), 0, PIXELS / 16);
}

static void the_mean_ratio_is_the_truth_of_every_kind_of_light(void **state) {
    (void)state;
    stage s;
    open_stage(&s);
    set_lights(&s, one_of_each_kind, KINDS);
    check_against_truth(&s, NULL, 0.01);
    close_stage(&s);
}

static void the_mean_ratio_is_the_truth_of_spheres_near_and_far(void **state) {
    (void)state;
    const lmp_light spheres[] = {
        { .position = { -0.7f, 0.5f, 0.2f }, .radius = 0.2f, .radiance = { 9, 3, 1 } },
        { .position = { 1.2f, 1.6f, 0.4f }, .radius = 0.5f, .radiance = { 1, 4, 2 } },
        { .position = { -40, 90, 60 }, .radius = 1, .radiance = { 9e3f, 9e3f, 2e4f } },
    };
    stage s;
    open_stage(&s);
    set_lights(&s, spheres, 3);
    check_against_truth(&s, NULL, 0.01);
    close_stage(&s);
}

static void the_mean_ratio_is_the_truth_of_an_environment(void **state) {
    (void)state;
    stage s;
    base_error error;
    environment e = { .azimuth = 0.4f };
    expect(image_create(&e.light, 32, 16, &error), &error);
    for (int i = 0; i < 3 * 32 * 16; i++)
        e.light.rgb[i] = (float)(i * 7919 % 101 + (i / 96 < 4 ? 300 : 0)) / 100;
    open_stage(&s);
    expect(environment_project(&e, BANDS, &error), &error);
    gpu_set_environment(s.renderer, &e);
    set_lights(&s, one_of_each_kind, 1);
    check_against_truth(&s, &e, 0.01);
    close_stage(&s);
    environment_free(&e);
}

static void make_coated_scene(scene *world) {
    make_things(world, 0.02f, 1);
}

/* Over a dark base the choice of lights is that of coats. */
static void the_mean_ratio_is_the_truth_under_coats(void **state) {
    (void)state;
    const lmp_light spheres[] = {
        { .position = { -0.7f, 0.5f, 0.2f }, .radius = 0.3f, .radiance = { 9, 3, 1 } },
        { .position = { 0.6f, 1.6f, -1.4f }, .radius = 0.4f, .radiance = { 1, 4, 2 } },
    };
    stage s;
    open_scene_stage(&s, make_coated_scene);
    set_lights(&s, spheres, 2);
    check_over_black(&s, 0.01);
    close_stage(&s);
}

/* Checks a built-in scene as the program draws it. What textures and edges change in unshadowed
 * images is not judged. */
static void check_builtin(const char *name) {
    stage s;
    base_error error = { "" };
    const int size[2] = { WIDTH, HEIGHT };
    if (check_count(0, 1) == 0)
        skip();
    expect(scene_load(name, &(scene_options) { 0 }, &s.world, &error), &error);
    s.renderer = open_renderer(&s.world);
    s.frame = frame_of(&s.world, WIDTH, HEIGHT);
    expect(
        scene_place_camera(&s.world, &(scene_camera_options) { 0 }, size, &s.frame.camera, &error),
        &error);
    s.frame.bands = BANDS;
    s.frame.cpu_shader = shade_frame;
    assert_in_range(judge(&s, NULL, 0.01), PIXELS / 2, PIXELS);
    close_stage(&s);
}

static void the_mean_ratio_is_the_truth_in_the_atrium(void **state) {
    (void)state;
    check_builtin("builtin:atrium");
}

static void the_mean_ratio_is_the_truth_of_the_ball(void **state) {
    (void)state;
    check_builtin("builtin:ball");
}

/* --- limits ----------------------------------------------------------------------------------- */

static void any_number_of_threads_gives_the_same_bits(void **state) {
    (void)state;
    static const int threads[] = { 1, 2, 7 };
    const int before = omp_get_max_threads();
    stage s;
    open_stage(&s);
    set_lights(&s, one_of_each_kind, KINDS);
    s.frame.samples = 2;
    for (int sparse = 0; sparse < 2; sparse++) {
        const shadow_settings settings = { .rays = 3, .seed = 5, .sparse = sparse != 0 };
        image drawn[3];
        for (int i = 0; i < 3; i++) {
            omp_set_num_threads(threads[i]);
            drawn[i] = draw_shadows(&s, NULL, &settings);
            assert_memory_equal(drawn[i].rgb, drawn[0].rgb, 3 * PIXELS * sizeof(float));
        }
        for (int i = 0; i < 3; i++)
            image_free(&drawn[i]);
    }
    omp_set_num_threads(before);
    close_stage(&s);
}

static void both_devices_have_the_same_shadows(void **state) {
    (void)state;
    stage s;
    open_stage(&s);
    set_lights(&s, one_of_each_kind, KINDS);
    image cpu = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 4 });
    s.frame.cpu_shader = NULL;
    image gpu = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 4 });
    for (int i = 0; i < 3 * PIXELS; i++)
        CHECK_WITHIN(fabsf(cpu.rgb[i] - gpu.rgb[i]), 1e-3f * (1 + cpu.rgb[i]));
    image_free(&cpu);
    image_free(&gpu);
    close_stage(&s);
}

/* Makes a ball as a vase, `waist` narrower in the middle, of some segments and half as many rings.
 */
static void make_round(scene *world, float waist, int segments) {
    enum { RINGS_MAX = 256 };
    const int rings = segments / 2;
    scene_builder builder = { .out_of_memory = false };
    shape_point profile[RINGS_MAX + 1];
    add_material(&builder, "ball", 0.8f);
    scene_shaper shaper = { .builder = &builder };
    assert_in_range(rings, 1, RINGS_MAX);
    for (int i = 0; i <= rings; i++) {
        const float angle = PI * (float)i / (float)rings, wide = sinf(angle);
        const float radius = wide * (1 - waist * wide * wide * wide * wide);
        profile[i] = (shape_point) { i % rings ? radius : 0, -cosf(angle) };
    }
    shape_revolve(&shaper, &(shape_revolution) { .profile = profile,
                                                 .point_count = rings + 1,
                                                 .origin = { 0.1f, 0.5f, 0 },
                                                 .axis = 'y',
                                                 .segments = segments });
    shaper_finish(&shaper);
    open_scene(&builder, world);
}

static void make_ball(scene *world) {
    make_round(world, 0, 32);
}

static void make_vase(scene *world) {
    make_round(world, 0.7f, 32);
}

static void make_fine_vase(scene *world) {
    make_round(world, 0.7f, 512);
}

/* The ball is lit where its normals face the light, and only there. */
static void a_coarse_ball_does_not_shade_itself(void **state) {
    (void)state;
    int lit = 0, dark = 0;
    stage s;
    open_scene_stage(&s, make_ball);
    set_lights(&s,
               &(lmp_light) { .kind = LMP_LIGHT_DIRECTIONAL,
                              .direction = { 0.96f, 0.28f, 0 },
                              .irradiance = { 1, 1, 1 } },
               1);
    image all = render_image(s.renderer, &s.frame);
    image pixels = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 1, .raw = true });
    for (int i = 0; i < 3 * PIXELS; i += 3) {
        const bool faces = all.rgb[i] > 0.01f;
        lit += faces;
        dark += faces && pixels.rgb[i] < 0.99f * all.rgb[i];
    }
    print_message("%d of %d lit pixels are dark\n", dark, lit);
    assert_in_range(lit, PIXELS / 20, PIXELS);
    assert_int_equal(dark, 0);
    image_free(&all);
    image_free(&pixels);
    close_stage(&s);
}

/* Renders the truth under suns all around, some low and some high. */
static ground_truth vase_truth(void (*make)(scene *world)) {
    enum { SUNS = 12 };
    lmp_light suns[SUNS];
    stage s;
    for (int i = 0; i < SUNS; i++) {
        const float angle = 2 * PI * (float)i / SUNS;
        const float up = i % 2 ? 0.28f : 0.8f, aside = i % 2 ? 0.96f : 0.6f;
        suns[i] = (lmp_light) { .kind = LMP_LIGHT_DIRECTIONAL,
                                .direction = { aside * cosf(angle), up, aside * sinf(angle) },
                                .irradiance = { 1, 1, 1 } };
    }
    open_scene_stage(&s, make);
    set_lights(&s, suns, SUNS);
    ground_truth t = find_truth(&s, NULL);
    close_stage(&s);
    return t;
}

/* The vase's facets would shade each other if rays left them. */
static void the_ground_truth_of_a_coarse_vase_is_that_of_a_fine_one(void **state) {
    (void)state;
    ground_truth coarse = vase_truth(make_vase), fine = vase_truth(make_fine_vase);
    double hidden = 0, error = 0;
    int lit = 0;
    for (int i = 0; i < 3 * PIXELS; i += 3) {
        if (!(coarse.lit.rgb[i] > 0.01f && fine.lit.rgb[i] > 0.01f))
            continue;
        const double arrives = (double)(fine.shadowed.rgb[i] / fine.lit.rgb[i]);
        lit++;
        hidden += 1 - arrives;
        error += fabs((double)(coarse.shadowed.rgb[i] / coarse.lit.rgb[i]) - arrives);
    }
    print_message("of %d pixels, %.4f are hidden, with an error of %.5f\n", lit, hidden / lit,
                  error / lit);
    assert_in_range(lit, PIXELS / 20, PIXELS);
    CHECK_WITHIN(error, 0.004 * lit);
    free_truth(&coarse);
    free_truth(&fine);
}

/* Counts the pixels that the light reaches. */
static int count_lit(stage *s, const lmp_light *light) {
    int lit = 0;
    set_lights(s, light, 1);
    image pixels = draw_shadows(s, NULL, &(shadow_settings) { .rays = 2 });
    for (int i = 0; i < PIXELS; i++) {
        for (int c = 0; c < 3; c++)
            assert_true(isfinite(pixels.rgb[3 * i + c]));
        lit += pixels.rgb[3 * i] > 1e-3f;
    }
    image_free(&pixels);
    return lit;
}

static void a_light_in_a_closed_box_lights_nothing_outside(void **state) {
    (void)state;
    stage s;
    open_stage(&s);
    assert_int_equal(count_lit(&s, &(lmp_light) { .position = { 1.2f, 0.35f, -0.3f },
                                                  .radius = 0.1f,
                                                  .radiance = { 50, 50, 50 } }),
                     0);
    close_stage(&s);
}

/* The lights contain a surface, touch one, or lie in one as a point. */
static void lights_that_meet_surfaces_are_finite(void **state) {
    (void)state;
    const lmp_light lights[] = {
        { .position = { 0, 0, 0 }, .radius = 1, .radiance = { 1, 1, 1 } },
        { .position = { 0, 1, 0 }, .radius = 1, .radiance = { 1, 1, 1 } },
        { .position = { 0, 0, 0 }, .radius = 40, .radiance = { 1, 1, 1 } },
        { .position = { 0, 0, 0 }, .radius = 0, .radiance = { 1, 1, 1 } },
        { .kind = LMP_LIGHT_POINT, .position = { 0, 0, 0 }, .intensity = { 1, 1, 1 } },
    };
    stage s;
    open_stage(&s);
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++)
        count_lit(&s, &lights[i]);
    close_stage(&s);
}

static void lay_floor(scene_shaper *shaper, float angle) {
    const float a = cosf(angle) * 4, b = sinf(angle) * 4;
    shape_quad(shaper, vec(-a, 0, b), vec(b, 0, a), vec(a, 0, -b), vec(-b, 0, -a));
}

static void make_floors(scene *world, int count) {
    scene_builder builder = { .out_of_memory = false };
    add_material(&builder, "floor", 0.8f);
    scene_shaper shaper = { .builder = &builder };
    for (int i = 0; i < count; i++)
        lay_floor(&shaper, 0.3f * (float)i);
    shaper_finish(&shaper);
    open_scene(&builder, world);
}

static void make_floor(scene *world) {
    make_floors(world, 1);
}

static void make_coinciding_floors(scene *world) {
    make_floors(world, 2);
}

/* The scene has different triangles in one plane. */
static void surfaces_that_coincide_do_not_shade_each_other(void **state) {
    (void)state;
    const lmp_light low = { .position = { -1, 0.4f, 0 }, .radius = 0.1f, .radiance = { 9, 9, 9 } };
    stage one, both;
    open_scene_stage(&one, make_floor);
    open_scene_stage(&both, make_coinciding_floors);
    const int lit = count_lit(&one, &low);
    assert_in_range(lit, PIXELS / 4, PIXELS);
    assert_true(count_lit(&both, &low) >= lit);
    set_lights(&both, &low, 1);
    image all = render_image(both.renderer, &both.frame);
    image drawn = draw_shadows(&both, NULL, &(shadow_settings) { .rays = 2 });
    assert_memory_equal(drawn.rgb, all.rgb, 3 * PIXELS * sizeof *all.rgb);
    image_free(&all);
    image_free(&drawn);
    close_stage(&one);
    close_stage(&both);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_ratio_is_the_truth_of_every_kind_of_light),
        cmocka_unit_test(the_mean_ratio_is_the_truth_of_spheres_near_and_far),
        cmocka_unit_test(the_mean_ratio_is_the_truth_of_an_environment),
        cmocka_unit_test(the_mean_ratio_is_the_truth_under_coats),
        cmocka_unit_test(the_mean_ratio_is_the_truth_in_the_atrium),
        cmocka_unit_test(the_mean_ratio_is_the_truth_of_the_ball),
        cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
        cmocka_unit_test(both_devices_have_the_same_shadows),
        cmocka_unit_test(a_coarse_ball_does_not_shade_itself),
        cmocka_unit_test(the_ground_truth_of_a_coarse_vase_is_that_of_a_fine_one),
        cmocka_unit_test(a_light_in_a_closed_box_lights_nothing_outside),
        cmocka_unit_test(lights_that_meet_surfaces_are_finite),
        cmocka_unit_test(surfaces_that_coincide_do_not_shade_each_other),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
