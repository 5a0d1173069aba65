/* SPDX-License-Identifier: MIT */
/* Images: what is written comes back, damaged files are refused, exposure and tone. */
#include "app/image/image.h"
#include "app/base/error.h"
#include "app/base/file.h"
#include "tests/program/folder.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 37, HEIGHT = 23, VALUES = 3 * WIDTH * HEIGHT };

static int remove_folder(void **state) {
    (void)state;
    static const char *const names[] = { "a.exr", "a.png", "bad.exr", "bad.png" };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        unlink(in_folder(names[i]));
    return rmdir(folder); /* no temporary file may be left */
}

static image noise(void) {
    image pixels;
    base_error error;
    assert_true(image_create(&pixels, WIDTH, HEIGHT, &error));
    for (size_t i = 0; i < VALUES; i++)
        pixels.rgb[i] = (float)exp(check_random_between(-30, 30));
    return pixels;
}

static void openexr_keeps_every_bit(void **state) {
    (void)state;
    base_error error = { "" };
    image main_layer = noise(), other = noise(), back;
    const image_layer layers[] = { { "", &main_layer }, { "error", &other } };
    assert_true(image_write_exr_layers(in_folder("a.exr"), layers, 2, &error));
    assert_true(image_read(in_folder("a.exr"), IMAGE_READ_PIXELS, &back, &error));
    assert_int_equal(back.width, WIDTH);
    assert_int_equal(back.height, HEIGHT);
    assert_memory_equal(back.rgb, main_layer.rgb, VALUES * sizeof(float));
    image_free(&back);
    image_free(&main_layer);
    image_free(&other);
}

static void png_keeps_every_byte(void **state) {
    (void)state;
    base_error error = { "" };
    static unsigned char bytes[VALUES];
    image back;
    for (size_t i = 0; i < VALUES; i++)
        bytes[i] = (unsigned char)(i % 256);
    assert_true(image_write_png8(bytes, WIDTH, HEIGHT, in_folder("a.png"), &error));
    assert_true(image_read(in_folder("a.png"), IMAGE_READ_PIXELS, &back, &error));
    for (size_t i = 0; i < VALUES; i++) {
        const double linear = (double)back.rgb[i];
        const double stored =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
        CHECK_WITHIN(fabs(255 * stored - (double)bytes[i]), 1e-3);
    }
    image_free(&back);
}

/* Truncates a good file everywhere and damages it at random: it must be read or refused. */
static void survive_damage(const char *good, const char *bad) {
    base_error error = { "" };
    void *data;
    size_t size;
    char name[64];
    snprintf(name, sizeof name, "%s", good);
    assert_true(file_read(in_folder(name), 1 << 20, &data, &size, &error));
    unsigned char *bytes = data;
    int refused = 0, tries = 0;
    for (size_t step = 0; step < 300; step++) {
        const size_t length = step < 150 ? size * step / 150 : size;
        unsigned char before = 0;
        const size_t at = (size_t)(check_random() * (double)size);
        if (step >= 150) {
            before = bytes[at];
            bytes[at] = (unsigned char)(check_random() * 256);
        }
        FILE *stream = fopen(in_folder(bad), "wb");
        assert_non_null(stream);
        assert_int_equal(fwrite(bytes, 1, length, stream), length);
        fclose(stream);
        if (step >= 150)
            bytes[at] = before;
        image pixels;
        error.text[0] = '\0';
        if (image_read(in_folder(bad), IMAGE_READ_PIXELS, &pixels, &error)) {
            image_free(&pixels);
        } else {
            refused++;
            assert_true(error.text[0] && !strchr(error.text, '\n'));
            assert_non_null(strstr(error.text, bad));
        }
        tries++;
    }
    print_message("%s: %d of %d damaged files refused\n", good, refused, tries);
    assert_true(refused >= 140);
    free(data);
}

static void damaged_images_are_refused_in_one_line(void **state) {
    (void)state;
    survive_damage("a.exr", "bad.exr");
    survive_damage("a.png", "bad.png");
}

static void a_png_that_claims_to_be_huge_is_refused(void **state) {
    (void)state;
    /* A header of 65535 x 65535 pixels, with its checksum, and an empty IDAT. */
    static const unsigned char bytes[] = { 0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00,
                                           0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
                                           0xff, 0xff, 0x00, 0x00, 0xff, 0xff, 0x08, 0x02, 0x00,
                                           0x00, 0x00, 0x39, 0x67, 0x4e, 0x07, 0x00, 0x00, 0x00,
                                           0x00, 0x49, 0x44, 0x41, 0x54, 0x35, 0xaf, 0x06, 0x1e };
    base_error error = { "" };
    image pixels;
    FILE *stream = fopen(in_folder("bad.png"), "wb");
    assert_non_null(stream);
    fwrite(bytes, 1, sizeof bytes, stream);
    fclose(stream);
    assert_false(image_read(in_folder("bad.png"), IMAGE_READ_PIXELS, &pixels, &error));
    assert_non_null(strstr(error.text, "too large"));
}

static void more_pixels_than_wanted_are_refused(void **state) {
    (void)state;
    static const char *const names[] = { "a.png", "a.exr" };
    base_error error = { "" };
    image pixels;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        assert_false(image_read(in_folder(names[i]), WIDTH * HEIGHT - 1, &pixels, &error));
        assert_non_null(strstr(error.text, "an image of 37 x 23 is too large (850 pixels"));
        assert_true(image_read(in_folder(names[i]), WIDTH * HEIGHT, &pixels, &error));
        image_free(&pixels);
    }
}

static void paths_that_cannot_be_written_are_refused_at_once(void **state) {
    (void)state;
    base_error error = { "" };
    assert_true(image_check_path(in_folder("b.png"), &error));
    assert_true(access(in_folder("b.png"), F_OK) != 0); /* the name was only tested */
    assert_false(image_check_path(in_folder("none/b.png"), &error));
    assert_false(image_check_path(in_folder("b.jpg"), &error));
    assert_non_null(strstr(error.text, ".png or .exr"));
}

/* --- exposure and tone ------------------------------------------------------------------------ */

static void fill(image *pixels, float value) {
    for (size_t i = 0; i < VALUES; i++)
        pixels->rgb[i] = value;
}

static void exposure_puts_what_is_lit_at_middle_grey(void **state) {
    (void)state;
    image pixels = noise();
    fill(&pixels, 40);
    CHECK_WITHIN(fabs((double)image_auto_exposure(&pixels) * 40 / 0.18 - 1), 0.05);
    /* Background, lamps and NaN do not count. */
    for (size_t i = 0; i < VALUES / 2; i++)
        pixels.rgb[i] = 0;
    for (size_t i = VALUES / 2; i < VALUES / 2 + 36; i++)
        pixels.rgb[i] = 1e9f;
    pixels.rgb[VALUES - 1] = NAN;
    pixels.rgb[VALUES - 4] = INFINITY;
    CHECK_WITHIN(fabs((double)image_auto_exposure(&pixels) * 40 / 0.18 - 1), 0.05);
    /* Nor does what is black beside the rest. */
    for (size_t i = 0; i < VALUES / 2; i++)
        pixels.rgb[i] = 1e-5f;
    CHECK_WITHIN(fabs((double)image_auto_exposure(&pixels) * 40 / 0.18 - 1), 0.05);
    fill(&pixels, 0);
    assert_true(image_auto_exposure(&pixels) == 1);
    CHECK_WITHIN(fabs((double)image_exposure_of_stops(-2) - 0.25), 1e-7);
    image_free(&pixels);
}

static void the_curve_keeps_black_and_gray_rises_and_ends_white(void **state) {
    (void)state;
    static unsigned char bytes[VALUES];
    image pixels = noise();
    for (size_t i = 0; i < VALUES; i++)
        pixels.rgb[i] = powf(10, -4 + 8 * (float)(i / 3) / (float)(VALUES / 3));
    image_tone_map(&pixels, &(image_display) { .exposure = 1 }, bytes);
    for (size_t i = 3; i < VALUES; i++)
        assert_true(bytes[i] >= bytes[i - 3]);
    assert_int_equal(bytes[0], 0);
    assert_int_equal(bytes[VALUES - 1], 255);
    fill(&pixels, 0.18f);
    pixels.rgb[3] = pixels.rgb[4] = pixels.rgb[5] = NAN;
    pixels.rgb[6] = pixels.rgb[7] = pixels.rgb[8] = INFINITY;
    pixels.rgb[9] = pixels.rgb[10] = pixels.rgb[11] = -1;
    image_tone_map(&pixels, &(image_display) { .exposure = 1 }, bytes);
    assert_true(abs(bytes[0] - 118) <= 1); /* sRGB of 0.18 */
    assert_int_equal(bytes[3], 0);
    assert_int_equal(bytes[6], 255);
    assert_int_equal(bytes[9], 0);
    image_free(&pixels);
}

/* Orange lamps, each four times as bright as the one before, are no nearer to white than a red with
 * half of its green in it. */
static void bright_lamps_keep_their_hue(void **state) {
    (void)state;
    static unsigned char bytes[VALUES];
    image pixels = noise();
    for (float radiance = 4; radiance < 65504; radiance *= 4) {
        for (size_t i = 0; i < VALUES; i += 3) {
            pixels.rgb[i] = radiance;
            pixels.rgb[i + 1] = 0.4f * radiance;
            pixels.rgb[i + 2] = 0.05f * radiance;
        }
        image_tone_map(&pixels, &(image_display) { .exposure = 1 }, bytes);
        assert_true(bytes[0] >= 240);
        assert_true(bytes[0] >= bytes[1] + 30 && bytes[1] >= bytes[2] + 50);
    }
    image_free(&pixels);
}

/* A few bright surfaces limit the exposure: only the brightest twentieth is above 1.5. */
static void exposure_does_not_clip_what_is_lit(void **state) {
    (void)state;
    image pixels = noise();
    fill(&pixels, 1);
    for (size_t i = 0; i < VALUES / 10; i++)
        pixels.rgb[i] = 40;
    CHECK_WITHIN(fabs((double)image_auto_exposure(&pixels) * 40 / 1.5 - 1), 0.05);
    const image_lit lit = image_measure_lit(&pixels);
    assert_true(lit.part == 1);
    CHECK_WITHIN(fabs((double)lit.brightest / 40 - 1), 0.05);
    image_free(&pixels);
}

static void an_image_is_made_finite_before_it_is_written(void **state) {
    (void)state;
    image pixels = noise();
    pixels.rgb[0] = NAN;
    pixels.rgb[1] = INFINITY;
    pixels.rgb[2] = -INFINITY;
    pixels.rgb[3] = FLT_MAX;
    pixels.rgb[4] = -1;
    const float kept = pixels.rgb[5];
    image_make_finite(&pixels, "image.exr");
    assert_true(pixels.rgb[0] == 0 && pixels.rgb[1] == FLT_MAX && pixels.rgb[2] == -FLT_MAX);
    assert_true(pixels.rgb[3] == FLT_MAX && pixels.rgb[4] == -1 && pixels.rgb[5] == kept);
    image_free(&pixels);
}

static void every_curve_is_chosen_by_its_name_and_the_linear_one_does_nothing(void **state) {
    (void)state;
    static unsigned char mapped[VALUES], encoded[VALUES];
    image pixels = noise();
    image_display display = { .exposure = 1 };
    assert_string_equal(image_tone_names()[display.tone], "filmic");
    while (strcmp(image_tone_names()[display.tone], "linear") != 0)
        display.tone++;
    for (size_t i = 0; i < VALUES; i++)
        pixels.rgb[i] = (float)i / (float)VALUES;
    image_encode(&pixels, encoded);
    image_tone_map(&pixels, &display, mapped);
    assert_memory_equal(mapped, encoded, VALUES);
    image_free(&pixels);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(openexr_keeps_every_bit),
        cmocka_unit_test(png_keeps_every_byte),
        cmocka_unit_test(damaged_images_are_refused_in_one_line),
        cmocka_unit_test(a_png_that_claims_to_be_huge_is_refused),
        cmocka_unit_test(more_pixels_than_wanted_are_refused),
        cmocka_unit_test(paths_that_cannot_be_written_are_refused_at_once),
        cmocka_unit_test(exposure_puts_what_is_lit_at_middle_grey),
        cmocka_unit_test(exposure_does_not_clip_what_is_lit),
        cmocka_unit_test(bright_lamps_keep_their_hue),
        cmocka_unit_test(the_curve_keeps_black_and_gray_rises_and_ends_white),
        cmocka_unit_test(an_image_is_made_finite_before_it_is_written),
        cmocka_unit_test(every_curve_is_chosen_by_its_name_and_the_linear_one_does_nothing),
    };
    return cmocka_run_group_tests(tests, folder_make, remove_folder);
}
