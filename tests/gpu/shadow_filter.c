/* SPDX-License-Identifier: MIT */
/* What the filter of shadows gains, and what it must not blur. */
#include "app/base/timing.h"
#include "tests/gpu/shadow.h"

static double relative_error(const image *drawn, const image *true_image) {
    const int count = 3 * drawn->width * drawn->height;
    double sum = 0;
    for (int i = 0; i < count; i++) {
        const double t = (double)true_image->rgb[i], d = (double)drawn->rgb[i] - t;
        sum += d * d / (t * t + 1e-4);
    }
    return sum / count;
}

static void the_filter_takes_nine_tenths_of_the_error(void **state) {
    (void)state;
    stage s;
    lmp_light lanterns[24];
    open_stage(&s);
    for (int i = 0; i < 24; i++)
        lanterns[i] =
            (lmp_light) { .position = { (float)(i % 6) * 0.9f - 2.2f, 1.5f + 0.3f * (float)(i % 4),
                                        2.6f - (float)(i / 6) },
                          .radius = 0.25f,
                          .radiance = { 1, 1, 1 } };
    set_lights(&s, lanterns, 24);
    s.frame.width *= 4;
    s.frame.height *= 4;
    image many = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 512, .seed = 9, .raw = true });
    image raw = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 2, .raw = true });
    image filtered = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 2 });
    const double before = relative_error(&raw, &many), after = relative_error(&filtered, &many);
    print_message("relative error %.4f unfiltered, %.4f filtered\n", before, after);
    assert_true(after * 10 <= before);
    image_free(&many);
    image_free(&raw);
    image_free(&filtered);
    close_stage(&s);
}

static void many_filtered_samples_come_to_the_truth(void **state) {
    (void)state;
    stage s;
    open_stage(&s);
    set_lights(
        &s, &(lmp_light) { .position = { 0.5f, 2.5f, 2 }, .radius = 0.4f, .radiance = { 9, 9, 9 } },
        1);
    static const int samples[3] = { 1, 8, 64 };
    const shadow_settings exact = { .rays = 64, .seed = 9, .raw = true };
    double error[3];
    for (int i = 0; i < 3; i++) {
        s.frame.samples = samples[i];
        image truth = draw_shadows(&s, NULL, &exact);
        image pixels = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 2 });
        error[i] = relative_error(&pixels, &truth);
        image_free(&truth);
        image_free(&pixels);
    }
    print_message("relative error of 1, 8, 64 samples: %.2e %.2e %.2e\n", error[0], error[1],
                  error[2]);
    assert_true(error[1] < 0.5 * error[0] && error[2] < 0.5 * error[1]);
    close_stage(&s);
}

/* A sixth of the rays are traced; the filter and the samples after stand in for the rest. */
static void neighbors_and_samples_share_their_rays(void **state) {
    (void)state;
    stage s;
    open_stage(&s);
    set_lights(
        &s, &(lmp_light) { .position = { 0.5f, 2.5f, 2 }, .radius = 0.4f, .radiance = { 9, 9, 9 } },
        1);
    s.frame.samples = 8;
    image truth = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 64, .seed = 9, .raw = true });
    image all = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 2 });
    image sparse = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 2, .sparse = true });
    const double error = relative_error(&sparse, &truth), least = relative_error(&all, &truth);
    print_message("relative error %.2e, %.2e of all rays\n", error, least);
    assert_true(error < 3 * least);
    image_free(&truth);
    image_free(&all);
    image_free(&sparse);
    close_stage(&s);
}

/* A roof above a floor. */
static void make_roof(scene *world) {
    scene_builder builder = { .out_of_memory = false };
    add_material(&builder, "floor", 0.8f);
    scene_shaper shaper = { .builder = &builder };
    shape_quad(&shaper, vec(-3, 0, 3), vec(3, 0, 3), vec(3, 0, -3), vec(-3, 0, -3));
    shape_quad(&shaper, vec(-0.4f, 1.5f, 0.4f), vec(0.4f, 1.5f, 0.4f), vec(0.4f, 1.5f, -0.4f),
               vec(-0.4f, 1.5f, -0.4f));
    shaper_finish(&shaper);
    open_scene(&builder, world);
}

/* Opens the roof, twice as wide and high, under one light. */
static void open_roof(stage *s, const lmp_light *light) {
    open_scene_stage(s, make_roof);
    s->frame.width *= 2;
    s->frame.height *= 2;
    set_lights(s, light, 1);
}

/* Returns the mean variance of the pixels from one seed to another. */
static double noise_of(stage *s, const environment *around, bool raw) {
    enum { SEEDS = 4, VALUES = 12 * PIXELS };
    static double sums[VALUES], squares[VALUES];
    double variance = 0;
    memset(sums, 0, sizeof sums);
    memset(squares, 0, sizeof squares);
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        image drawn = draw_shadows(s, around, &(shadow_settings) { .seed = seed, .raw = raw });
        for (int i = 0; i < VALUES; i++) {
            const double value = (double)drawn.rgb[i];
            sums[i] += value;
            squares[i] += value * value;
        }
        image_free(&drawn);
    }
    for (int i = 0; i < VALUES; i++)
        variance += (squares[i] - sums[i] * sums[i] / SEEDS) / VALUES;
    return variance;
}

/* The roof is nearer to the light than to the floor, so that penumbras are wide. */
static void wide_penumbras_are_mixed_widely(void **state) {
    (void)state;
    stage s;
    open_roof(&s,
              &(lmp_light) { .position = { 0, 2, 0 }, .radius = 0.3f, .radiance = { 9, 9, 9 } });
    const double raw = noise_of(&s, NULL, true), filtered = noise_of(&s, NULL, false);
    print_message("variance %.2e unfiltered, %.2e filtered\n", raw, filtered);
    assert_true(filtered * 100 <= raw);
    close_stage(&s);
}

/* Opens the roof under a sun, and makes an even sky. */
static environment open_day(stage *s) {
    static float gray[3 * 8 * 4];
    for (size_t i = 0; i < sizeof gray / sizeof *gray; i++)
        gray[i] = 0.2f;
    open_roof(s, &(lmp_light) { .kind = LMP_LIGHT_DIRECTIONAL,
                                .direction = { 0.28f, 0.96f, 0 },
                                .irradiance = { 3, 3, 3 } });
    return (environment) { .light = { 8, 4, gray } };
}

/* All that lights the shadow of a sun is the sky, whose own shadows are soft. */
static void the_sky_is_mixed_widely_in_the_shadow_of_a_sun(void **state) {
    (void)state;
    stage s;
    const environment sky = open_day(&s);
    const double raw = noise_of(&s, &sky, true), filtered = noise_of(&s, &sky, false);
    print_message("variance %.2e unfiltered, %.2e filtered\n", raw, filtered);
    assert_true(filtered * 300 <= raw);
    close_stage(&s);
}

/* The filters of sun and sky have other taps, and thus other parts of them without rays. */
static void pixels_without_rays_have_the_same_sky(void **state) {
    (void)state;
    stage s;
    const environment sky = open_day(&s);
    image truth =
        draw_shadows(&s, &sky, &(shadow_settings) { .rays = 256, .seed = 9, .raw = true });
    image all = draw_shadows(&s, &sky, &(shadow_settings) { .rays = 0 });
    image sparse = draw_shadows(&s, &sky, &(shadow_settings) { .sparse = true });
    const double error = relative_error(&sparse, &truth), least = relative_error(&all, &truth);
    print_message("relative error %.2e, %.2e of all rays\n", error, least);
    assert_true(error < 20 * least); /* most of it at the edges of the sun's shadow */
    image_free(&truth);
    image_free(&all);
    image_free(&sparse);
    close_stage(&s);
}

/* Each pixel is as bright as one of its neighbors should be, within a fiftieth of the light. */
static void edges_of_a_small_far_light_stay_within_a_pixel(void **state) {
    (void)state;
    stage s;
    open_roof(&s, &(lmp_light) { .position = { 40, 90, 20 },
                                 .radius = 0.1f,
                                 .radiance = { 1e6f, 1e6f, 1e6f } });
    const int width = s.frame.width, height = s.frame.height;
    image all = render_image(s.renderer, &s.frame);
    image exact = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 64, .raw = true });
    image drawn = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 2 });
    int edges = 0, wrong = 0;
    for (int y = 1; y + 1 < height; y++)
        for (int x = 1; x + 1 < width; x++) {
            const float value = drawn.rgb[3 * (y * width + x)];
            const float bound = 0.02f * all.rgb[3 * (y * width + x)];
            float least = INFINITY, most = 0;
            for (int k = 0; k < 9; k++) {
                const int neighbor = 3 * ((y + k / 3 - 1) * width + x + k % 3 - 1);
                least = fminf(least, exact.rgb[neighbor]);
                most = fmaxf(most, exact.rgb[neighbor]);
            }
            edges += least < 0.5f * most;
            wrong += !(value >= least - bound && value <= most + bound);
        }
    print_message("%d pixels at edges, %d pixels off\n", edges, wrong);
    assert_in_range(edges, 50, width * height);
    assert_int_equal(wrong, 0);
    image_free(&all);
    image_free(&exact);
    image_free(&drawn);
    close_stage(&s);
}

/* The stump of a column on a floor. */
static void make_column(scene *world) {
    scene_builder builder = { .out_of_memory = false };
    static const shape_point profile[] = { { 0.3f, 0 }, { 0.3f, 0.6f } };
    add_material(&builder, "stone", 0.8f);
    scene_shaper shaper = { .builder = &builder };
    shape_quad(&shaper, vec(-3, 0, 3), vec(3, 0, 3), vec(3, 0, -3), vec(-3, 0, -3));
    shape_revolve(&shaper, &(shape_revolution) { .profile = profile,
                                                 .point_count = 2,
                                                 .origin = { 0, 0, 0 },
                                                 .axis = 'y',
                                                 .segments = 32 });
    shaper_finish(&shaper);
    open_scene(&builder, world);
}

/* Finds what arrives relative to the light without shadows: red of a pixel, and the least and the
 * most around it. */
static void find_parts(const image *drawn, const image *all, int x, int y, float part[2]) {
    part[0] = INFINITY;
    part[1] = -INFINITY;
    for (int k = 0; k < 9; k++) {
        const int i = 3 * ((y + k / 3 - 1) * all->width + x + k % 3 - 1);
        const float value = all->rgb[i] > 0 ? drawn->rgb[i] / all->rgb[i] : 0;
        part[0] = fminf(part[0], value);
        part[1] = fmaxf(part[1], value);
    }
}

/* Filtered light must not arrive where no ray does, as behind the foot, and must arrive where all
 * rays do, as before it. */
static void check_foot(const image *drawn, const image *exact, const image *all) {
    double leak = 0, lost = 0;
    int dark = 0, lit = 0;
    for (int y = 1; y + 1 < all->height; y++)
        for (int x = 1; x + 1 < all->width; x++) {
            const int i = 3 * (y * all->width + x);
            float part[2];
            find_parts(exact, all, x, y, part);
            if (all->rgb[i] > 0 && part[1] == 0) {
                leak += (double)(drawn->rgb[i] / all->rgb[i]);
                dark++;
            }
            if (part[0] == 1) {
                lost += (double)(1 - drawn->rgb[i] / all->rgb[i]);
                lit++;
            }
        }
    print_message("of %d dark pixels %.1e leaks, of %d lit ones %.1e is lost\n", dark, leak / dark,
                  lit, lost / lit);
    assert_in_range(dark, 300, 4 * PIXELS);
    assert_in_range(lit, PIXELS, 4 * PIXELS);
    assert_true(leak <= 0.01 * dark && lost <= 0.01 * lit);
}

static void the_foot_of_a_column_leaks_no_light(void **state) {
    (void)state;
    stage s;
    open_scene_stage(&s, make_column);
    s.frame.width *= 2;
    s.frame.height *= 2;
    set_lights(
        &s, &(lmp_light) { .position = { -2, 1.5f, 0 }, .radius = 0.1f, .radiance = { 9, 9, 9 } },
        1);
    image all = render_image(s.renderer, &s.frame);
    image exact = draw_shadows(&s, NULL, &(shadow_settings) { .rays = 256, .raw = true });
    for (int sparse = 0; sparse < 2; sparse++) {
        image drawn =
            draw_shadows(&s, NULL, &(shadow_settings) { .rays = 2, .sparse = sparse != 0 });
        check_foot(&drawn, &exact, &all);
        image_free(&drawn);
    }
    image_free(&all);
    image_free(&exact);
    close_stage(&s);
}

/* Under a sun over a floor that fills the image, each pixel traces as many rays as are asked for;
 * and the parts of a frame's time are no more than all of it. */
static void statistics_are_of_what_was_done(void **state) {
    (void)state;
    stage s;
    base_error error = { "" };
    const shadow_settings settings = { .rays = 3 };
    open_stage(&s);
    set_lights(&s,
               &(lmp_light) { .kind = LMP_LIGHT_DIRECTIONAL,
                              .direction = { 0, 0.8f, 0.6f },
                              .irradiance = { 1, 1, 1 } },
               1);
    s.frame.camera = (scene_camera) {
        .eye = { 2.3f, 1, 2.3f }, .target = { 2.3f, 0, 2.2f }, .up = { 0, 1, 0 }, .fov = 0.3f
    };
    trace_bvh *bvh = trace_create(&s.world);
    shadow *all = shadow_create(&s.world, bvh, NULL, &settings, &error);
    expect(all != NULL, &error);
    s.frame.shadow = shadow_pass(all);
    const double start = timing_now();
    image pixels = render_image(s.renderer, &s.frame);
    const double passed = 1e3 * (timing_now() - start);
    const shadow_statistics found = shadow_describe(all);
    assert_int_equal(found.rays, 3 * PIXELS);
    assert_true(found.rays_milliseconds >= 0 && found.filter_milliseconds >= 0);
    CHECK_WITHIN(found.rays_milliseconds + found.filter_milliseconds, passed);
    image_free(&pixels);
    shadow_destroy(all);
    trace_destroy(bvh);
    close_stage(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_filter_takes_nine_tenths_of_the_error),
        cmocka_unit_test(many_filtered_samples_come_to_the_truth),
        cmocka_unit_test(neighbors_and_samples_share_their_rays),
        cmocka_unit_test(wide_penumbras_are_mixed_widely),
        cmocka_unit_test(the_sky_is_mixed_widely_in_the_shadow_of_a_sun),
        cmocka_unit_test(pixels_without_rays_have_the_same_sky),
        cmocka_unit_test(edges_of_a_small_far_light_stay_within_a_pixel),
        cmocka_unit_test(the_foot_of_a_column_leaks_no_light),
        cmocka_unit_test(statistics_are_of_what_was_done),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
