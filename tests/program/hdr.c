/* SPDX-License-Identifier: MIT */
/* Radiance images: both packings give what the format says, whatever is cut or changed is refused
 * or read, and no more. */
#include "app/image/image.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <string.h>

enum { SIZE_MAX_BYTES = 4096 };

typedef struct file {
    unsigned char bytes[SIZE_MAX_BYTES];
    size_t size;
} file;

static void put(file *f, const void *bytes, size_t size) {
    assert_true(f->size + size <= sizeof f->bytes);
    memcpy(f->bytes + f->size, bytes, size);
    f->size += size;
}

static void put_text(file *f, const char *text) {
    put(f, text, strlen(text));
}

static bool decodes(const file *f, image *pixels, cli_error *error) {
    const image_source source = {
        .path = "input.hdr", .data = f->bytes, .size = f->size, .pixels_max = 1 << 20
    };
    *error = (cli_error) { .text = "" };
    return image_decode_hdr(&source, pixels, error);
}

#define HEAD "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"

/* A mantissa m and an exponent e are m 2^(e - 136); an exponent of 0 is black. */
static void pixels_are_mantissas_and_an_exponent(void **state) {
    (void)state;
    file f = { .size = 0 };
    image pixels;
    cli_error error;
    put_text(&f, HEAD "EXPOSURE=2\nEXPOSURE=4\n\n-Y 2 +X 2\n");
    put(&f, (unsigned char[]) { 128, 64, 255, 129, 9, 9, 9, 0, 1, 2, 3, 136, 1, 1, 1, 1 }, 16);
    if (!decodes(&f, &pixels, &error))
        fail_msg("%s", error.text);
    /* Exposures were multiplied in: 1/8 of what is stored. */
    const double expected[12] = { 1 / 8.0, 0.5 / 8, 255 / 128.0 / 8, 0,       0,       0,
                                  1 / 8.0, 2 / 8.0, 3 / 8.0,         1 / 8.0, 2 / 8.0, 3 / 8.0 };
    for (int i = 0; i < 12; i++)
        CHECK_WITHIN(fabs((double)pixels.rgb[i] - expected[i]), 1e-9);
    image_free(&pixels);
}

/* Rows of 8 to 32767 pixels: each channel for itself, in runs of one byte and of others. */
static void packed_rows_are_unpacked(void **state) {
    (void)state;
    file f = { .size = 0 };
    image pixels;
    cli_error error;
    put_text(&f, HEAD "\n-Y 1 +X 260\n");
    put(&f, (unsigned char[]) { 2, 2, 1, 4 }, 4);
    for (int channel = 0; channel < 3; channel++) {
        const unsigned char literal[5] = { 4, 10, 20, 30, (unsigned char)(40 + channel) };
        put(&f, literal, 5);
        put(&f, (unsigned char[]) { 255, 50, 255, 51, 130, 52 }, 6);
    }
    put(&f, (unsigned char[]) { 255, 136, 255, 136, 134, 136 }, 6);
    if (!decodes(&f, &pixels, &error))
        fail_msg("%s", error.text);
    assert_int_equal(pixels.width, 260);
    assert_true(pixels.rgb[0] == 10 && pixels.rgb[3 * 3 + 2] == 42);
    assert_true(pixels.rgb[3 * 4] == 50 && pixels.rgb[3 * 130] == 50 && pixels.rgb[3 * 131] == 51);
    assert_true(pixels.rgb[3 * 259 + 1] == 52);
    image_free(&pixels);
}

static void what_is_no_radiance_image_is_refused_by_its_reason(void **state) {
    (void)state;
    static const struct {
        const char *text, *refusal;
    } cases[] = {
        { "", "does not begin with #?" },
        { "P6\n", "does not begin with #?" },
        { "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd",
          "of format \"32-bit_rle_xyze\"" },
        { HEAD "EXPOSURE=0\n\n-Y 1 +X 1\nabcd", "an exposure that makes no sense" },
        { HEAD "\n+Y 1 +X 1\nabcd", "rows that do not run" },
        { HEAD "\n-Y 1 +X 99999\n", "too large" },
        { HEAD "\n-Y 0 +X 1\n", "too large" },
        { HEAD "\n-Y 1 +X 1\nabc", "row 0" },
        { HEAD "\n-Y 1 +X 1\n\1\1\1\1", "row 0" },
        { HEAD "\n-Y 1 +X 8\n\2\2\1\10", "row 0" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        file f = { .size = 0 };
        image pixels;
        cli_error error;
        put_text(&f, cases[i].text);
        if (decodes(&f, &pixels, &error) || !strstr(error.text, cases[i].refusal))
            fail_msg("case %zu: \"%s\"", i, error.text);
    }
}

static void damage_does_no_harm(void **state) {
    (void)state;
    for (int i = 0; i < check_count(2000, 200000); i++) {
        file f = { .size = 0 };
        image pixels;
        cli_error error;
        put_text(&f, HEAD "\n-Y 3 +X 9\n");
        for (int row = 0; row < 3; row++) {
            put(&f, (unsigned char[]) { 2, 2, 0, 9 }, 4);
            for (int channel = 0; channel < 4; channel++)
                put(&f, (unsigned char[]) { 5, 1, 2, 3, 4, 5, 132, 7 }, 8);
        }
        const size_t at = (size_t)check_random_between(0, (double)f.size);
        if (i % 2)
            f.bytes[at] = (unsigned char)check_random_between(0, 256);
        else
            f.size = at;
        const bool ok = decodes(&f, &pixels, &error);
        assert_true(i % 2 || !ok);
        if (ok)
            image_free(&pixels);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_mantissas_and_an_exponent),
        cmocka_unit_test(packed_rows_are_unpacked),
        cmocka_unit_test(what_is_no_radiance_image_is_refused_by_its_reason),
        cmocka_unit_test(damage_does_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
