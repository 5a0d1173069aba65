/* SPDX-License-Identifier: MIT */
/* Samples of a pixel under surfaces that blend, against alpha blending itself. */
#include "app/scene/trace/blend.h"

#include "tests/oracle/check.h"

#include <math.h>

enum { LAYERS = 12 };

/* Adds up the weights of all samples of a pixel by what they see: a layer, or what is behind all
 * layers. */
static void look(uint32_t pixel, uint32_t samples, const float *alphas, int layers,
                 double seen[LAYERS + 1]) {
    for (uint32_t i = 0; i < samples; i++) {
        blend_part part = blend_begin(pixel % 1000, pixel / 1000, i, samples);
        int layer = 0;
        while (layer < layers && !blend_sees(&part, alphas[layer]))
            layer++;
        seen[layer] += (double)part.weight / samples;
    }
}

/* Computes the weight that alpha blending gives each layer, and what is behind all. */
static void blend(const float *alphas, int layers, double expected[LAYERS + 1]) {
    double through = 1;
    for (int k = 0; k < layers; k++) {
        expected[k] = through * (double)alphas[k];
        through *= 1 - (double)alphas[k];
    }
    expected[layers] = through;
}

/* Five of these surfaces leave at least two of eight samples. */
static void few_surfaces_blend_exactly_in_every_pixel(void **state) {
    (void)state;
    for (uint32_t pixel = 0; pixel < 2000; pixel++) {
        const int layers = 1 + (int)(pixel % 5);
        float alphas[LAYERS];
        double seen[LAYERS + 1] = { 0 }, expected[LAYERS + 1];
        for (int k = 0; k < layers; k++)
            alphas[k] = (float)check_random_between(0.001, 0.4);
        blend(alphas, layers, expected);
        look(pixel, 8, alphas, layers, seen);
        for (int k = 0; k <= layers; k++)
            CHECK_WITHIN(fabs(seen[k] - expected[k]), 1e-6);
    }
}

/* With more surfaces than samples, and with single samples, the mean of many pixels is exact. */
static void any_number_of_surfaces_blends_in_the_mean_of_pixels(void **state) {
    (void)state;
    static const uint32_t samples[] = { 1, 2, 3, 8, 32 };
    enum { PIXELS = 200000 };
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        float alphas[LAYERS];
        double seen[LAYERS + 1] = { 0 }, expected[LAYERS + 1];
        for (int k = 0; k < LAYERS; k++)
            alphas[k] = (float)check_random_between(0, 0.6);
        blend(alphas, LAYERS, expected);
        for (uint32_t pixel = 0; pixel < PIXELS; pixel++)
            look(pixel, samples[i], alphas, LAYERS, seen);
        /* Five standard deviations of a coin's mean; the last of two samples decides twice alike.
         */
        for (int k = 0; k <= LAYERS; k++)
            CHECK_WITHIN(fabs(seen[k] / PIXELS - expected[k]), 0.01);
    }
}

static void what_hides_nothing_or_all_is_not_blended(void **state) {
    (void)state;
    for (uint32_t i = 0; i < 8; i++) {
        blend_part part = blend_begin(1, 2, i, 8);
        assert_false(blend_sees(&part, 0));
        assert_true(blend_sees(&part, 1));
        assert_false(part.blended);
        assert_true(part.weight == 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_surfaces_blend_exactly_in_every_pixel),
        cmocka_unit_test(any_number_of_surfaces_blends_in_the_mean_of_pixels),
        cmocka_unit_test(what_hides_nothing_or_all_is_not_blended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
