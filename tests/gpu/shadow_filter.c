/* SPDX-License-Identifier: MIT */
/* What the filter of shadows gains, and what it must not blur. */
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_filter_takes_nine_tenths_of_the_error),
        cmocka_unit_test(many_filtered_samples_come_to_the_truth),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
