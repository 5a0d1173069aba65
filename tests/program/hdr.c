/* SPDX-License-Identifier: MIT */
/* Radiance images: both packings give what the format says, and files that are truncated or changed
 * are refused or read, without a crash. */
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

static bool decodes(const file *f, image *pixels, base_error *error) {
    const image_source source = {
        .path = "input.hdr", .data = f->bytes, .size = f->size, .pixels_max = 1 << 20
    };
    *error = (base_error) { .text = "" };
    return image_decode_hdr(&source, pixels, error);
}

#define HEAD "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"

/* A mantissa m and an exponent e are m 2^(e - 136); an exponent of 0 is black. */
static void pixels_are_mantissas_and_an_exponent(void **state) {
    (void)state;
    file f = { .size = 0 };
    image pixels;
    base_error error;
    put_text(&f, HEAD "EXPOSURE=2\nEXPOSURE=4\n\n-Y 2 +X 2\n");
    put(&f, (unsigned char[]) { 128, 64, 255, 129, 9, 9, 9, 0, 1, 2, 3, 136, 1, 1, 1, 1 }, 16);
    if (!decodes(&f, &pixels, &error))
        fail_msg("%s", error.text);
    /* Exposures were multiplied in, so the values are 1/8 of those stored. */
    const double expected[12] = { 1 / 8.0, 0.5 / 8, 255 / 128.0 / 8, 0,       0,       0,
                                  1 / 8.0, 2 / 8.0, 3 / 8.0,         1 / 8.0, 2 / 8.0, 3 / 8.0 };
    for (int i = 0; i < 12; i++)
        CHECK_WITHIN(fabs((double)pixels.rgb[i] - expected[i]), 1e-9);
    image_free(&pixels);
}

/* Rows of 8 to 32767 pixels store each channel by itself, in runs of one byte and of different
 * bytes. */
static void packed_rows_are_unpacked(void **state) {
    (void)state;
    file f = { .size = 0 };
    image pixels;
    base_error error;
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

static void expect(const file *f, int width, int height, const double *rgb, double bound) {
    image pixels;
    base_error error;
    if (!decodes(f, &pixels, &error))
        fail_msg("%s", error.text);
    assert_int_equal(pixels.width, width);
    assert_int_equal(pixels.height, height);
    for (int i = 0; i < 3 * width * height; i++)
        if (!(fabs((double)pixels.rgb[i] - rgb[i]) <= bound))
            fail_msg("value %d: %g, not %g", i, (double)pixels.rgb[i], rgb[i]);
    image_free(&pixels);
}

/* Six pixels of an image of 3 x 2, stored along either axis, from either end. */
static void scanlines_run_in_eight_directions(void **state) {
    (void)state;
    static const struct {
        const char *size;
        int order[6];
    } cases[] = {
        { "-Y 2 +X 3", { 1, 2, 3, 4, 5, 6 } }, { "-Y 2 -X 3", { 3, 2, 1, 6, 5, 4 } },
        { "+Y 2 +X 3", { 4, 5, 6, 1, 2, 3 } }, { "+Y 2 -X 3", { 6, 5, 4, 3, 2, 1 } },
        { "+X 3 -Y 2", { 1, 4, 2, 5, 3, 6 } }, { "-X 3 -Y 2", { 3, 6, 2, 5, 1, 4 } },
        { "+X 3 +Y 2", { 4, 1, 5, 2, 6, 3 } }, { "-X 3 +Y 2", { 6, 3, 5, 2, 4, 1 } },
    };
    double rgb[18];
    for (int i = 0; i < 18; i++)
        rgb[i] = 10 + i / 3;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        file f = { .size = 0 };
        put_text(&f, HEAD "\n");
        put_text(&f, cases[k].size);
        put_text(&f, "\n");
        for (int i = 0; i < 6; i++) {
            const unsigned char n = (unsigned char)(9 + cases[k].order[i]);
            put(&f, (unsigned char[]) { n, n, n, 136 }, 4);
        }
        expect(&f, 3, 2, rgb, 0);
    }
}

/* Exposures and color corrections were multiplied in one after the other. */
static void color_corrections_are_undone(void **state) {
    (void)state;
    file f = { .size = 0 };
    put_text(&f, HEAD "COLORCORR= 2 4 .5\nEXPOSURE= 2 \nCOLORCORR=1 1\t2\n\n-Y 1 +X 1\n");
    put(&f, (unsigned char[]) { 8, 16, 32, 136 }, 4);
    expect(&f, 1, 1, (const double[]) { 2, 2, 16 }, 1e-9);
}

/* The image holds the white, the red, the green and the blue of Rec. 709 as XYZ. */
static void xyz_becomes_rec_709(void **state) {
    (void)state;
    static const double xyz[4][3] = { { 95.0456, 100, 108.9058 },
                                      { 41.2391, 21.2639, 1.9331 },
                                      { 35.7584, 71.5169, 11.9195 },
                                      { 18.0481, 7.2192, 95.0532 } };
    static const double rgb[12] = { 100, 100, 100, 100, 0, 0, 0, 100, 0, 0, 0, 100 };
    file f = { .size = 0 };
    put_text(&f, "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 4\n");
    for (int i = 0; i < 4; i++) {
        unsigned char pixel[4] = { 0, 0, 0, 136 };
        for (int c = 0; c < 3; c++)
            pixel[c] = (unsigned char)(xyz[i][c] + 0.5);
        put(&f, pixel, 4);
    }
    expect(&f, 4, 1, rgb, 2.7); /* half a step of each, through the matrix */
}

static void headers_have_lines_of_any_length_and_either_end(void **state) {
    (void)state;
    file f = { .size = 0 };
    char command[1200];
    memset(command, 'x', sizeof command - 1);
    command[sizeof command - 1] = 0;
    put_text(&f, "#?RGBE\r\nFORMAT=32-bit_rle_rgbe\r\n");
    put_text(&f, command);
    put_text(&f, "\r\n\r\n-Y 1 +X 1\r\n");
    put(&f, (unsigned char[]) { 1, 2, 3, 136 }, 4);
    expect(&f, 1, 1, (const double[]) { 1, 2, 3 }, 0);
}

static void what_is_no_radiance_image_is_refused_by_its_reason(void **state) {
    (void)state;
    static const struct {
        const char *text, *refusal;
    } cases[] = {
        { "", "does not begin with #?" },
        { "P6\n", "does not begin with #?" },
        { "#?RADIANCE\nFORMAT=32-bit_rle_luv\n\n-Y 1 +X 1\nabcd", "of format \"32-bit_rle_luv\"" },
        { HEAD "COLORCORR=1 0 1\n\n-Y 1 +X 1\nabcd", "an invalid color correction" },
        { HEAD "COLORCORR=1 1\n\n-Y 1 +X 1\nabcd", "an invalid color correction" },
        { HEAD "EXPOSURE=0\n\n-Y 1 +X 1\nabcd", "an invalid exposure" },
        { HEAD "\n+Y 1 +Y 1\nabcd", "has no size" },
        { HEAD "\n-Y 1 +X\nabcd", "has no size" },
        { HEAD "\n-Y 1 +X 1 1\nabcd", "has no size" },
        { HEAD "\n-Y 1 +X 99999\n", "too large" },
        { HEAD "\n-Y 0 +X 1\n", "too large" },
        { HEAD "\n-Y 1 +X 1\nabc", "row 0" },
        { HEAD "\n-Y 1 +X 1\n\1\1\1\1", "row 0" },
        { HEAD "\n-Y 1 +X 8\n\2\2\1\10", "row 0" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        file f = { .size = 0 };
        image pixels;
        base_error error;
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
        base_error error;
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
        cmocka_unit_test(scanlines_run_in_eight_directions),
        cmocka_unit_test(color_corrections_are_undone),
        cmocka_unit_test(xyz_becomes_rec_709),
        cmocka_unit_test(headers_have_lines_of_any_length_and_either_end),
        cmocka_unit_test(what_is_no_radiance_image_is_refused_by_its_reason),
        cmocka_unit_test(damage_does_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
