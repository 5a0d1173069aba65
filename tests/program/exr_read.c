/* SPDX-License-Identifier: MIT */
/* OpenEXR images of luminance and chroma: files built here, byte by byte, give the colors that they
 * were built from. */
#include "app/image/exr.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 40, HEIGHT = 36, SIZE_MAX_BYTES = 1 << 16, EDGE = 14 /* EDGE: of the filter */ };

typedef struct file {
    unsigned char bytes[SIZE_MAX_BYTES];
    size_t size;
} file;

static void put(file *f, const void *bytes, size_t size) {
    assert_true(f->size + size <= sizeof f->bytes);
    memcpy(f->bytes + f->size, bytes, size);
    f->size += size;
}

static void put_number(file *f, int32_t number) {
    put(f, &number, 4);
}

static void put_attribute(file *f, const char *name, const char *type, const void *data,
                          size_t size) {
    put(f, name, strlen(name) + 1);
    put(f, type, strlen(type) + 1);
    put_number(f, (int32_t)size);
    put(f, data, size);
}

/* What a file holds, with chroma at every `step`-th pixel, or none if step is 0. */
typedef struct kind {
    int step;
    bool half;
    const float *chromaticities; /* of red, green, blue, white; NULL: Rec. 709's, unstated */
    double weights[3];           /* weights of R, G and B in Y */
} kind;

static void put_channels(file *f, const kind *k) {
    static const char *const names[] = { "BY", "RY", "Y" };
    unsigned char list[80] = { 0 };
    size_t size = 0;
    for (int i = k->step ? 0 : 2; i < 3; i++) {
        const int32_t type = k->half ? 1 : 2, sampling = i < 2 ? k->step : 1;
        strcpy((char *)list + size, names[i]);
        size += strlen(names[i]) + 1;
        memcpy(list + size, &type, 4);
        memcpy(list + size + 8, &sampling, 4);
        memcpy(list + size + 12, &sampling, 4);
        size += 16;
    }
    put_attribute(f, "channels", "chlist", list, size + 1);
}

static void put_header(file *f, const kind *k) {
    const int32_t window[] = { 0, 0, WIDTH - 1, HEIGHT - 1 };
    const float one = 1, center[] = { 0, 0 };
    put(f, "\x76\x2f\x31\x01", 4);
    put_number(f, 2);
    put_channels(f, k);
    if (k->chromaticities)
        put_attribute(f, "chromaticities", "chromaticities", k->chromaticities, 32);
    put_attribute(f, "compression", "compression", "", 1);
    put_attribute(f, "dataWindow", "box2i", window, sizeof window);
    put_attribute(f, "displayWindow", "box2i", window, sizeof window);
    put_attribute(f, "lineOrder", "lineOrder", "", 1);
    put_attribute(f, "pixelAspectRatio", "float", &one, sizeof one);
    put_attribute(f, "screenWindowCenter", "v2f", center, sizeof center);
    put_attribute(f, "screenWindowWidth", "float", &one, sizeof one);
    put(f, "", 1);
}

/* Chroma changes evenly over the image, and luminance does not. */
static double ry_at(int x, int y) {
    return 0.4 - 0.01 * x + 0.005 * y;
}

static double by_at(int x, int y) {
    return -0.2 + 0.008 * x - 0.01 * y;
}

static double y_at(int x, int y) {
    return 0.5 + (x * 7 + y * 13) % 11;
}

static void put_sample(file *f, const kind *k, double value) {
    const float number = fabs(value) < 1e-4 ? 0 : (float)value; /* a normal half */
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    if (!k->half) {
        put(f, &bits, 4);
        return;
    }
    const uint32_t exponent = bits ? (bits >> 23 & 255) - 112 : 0, mantissa = bits >> 13 & 1023;
    const uint16_t stored = (uint16_t)(bits >> 31 << 15 | exponent << 10 | mantissa);
    put(f, &stored, 2);
}

static void put_row(file *f, const kind *k, int y) {
    const size_t begin = f->size;
    put_number(f, y);
    put_number(f, 0);
    for (int c = 0; c < 2 && k->step && y % k->step == 0; c++)
        for (int x = 0; x < WIDTH; x += k->step)
            put_sample(f, k, c ? ry_at(x, y) : by_at(x, y));
    for (int x = 0; x < WIDTH; x++)
        put_sample(f, k, y_at(x, y));
    const uint32_t size = (uint32_t)(f->size - begin - 8);
    memcpy(f->bytes + begin + 4, &size, 4);
}

static file make(const kind *k) {
    file f = { .size = 0 };
    put_header(&f, k);
    const size_t table = f.size;
    for (int y = 0; y < HEIGHT; y++)
        put(&f, "\0\0\0\0\0\0\0", 8);
    for (int y = 0; y < HEIGHT; y++) {
        const uint64_t offset = f.size;
        memcpy(f.bytes + table + 8 * (size_t)y, &offset, 8);
        put_row(&f, k, y);
    }
    return f;
}

static void check_pixel(const kind *k, int x, int y, const float *rgb) {
    const double luminance = y_at(x, y), red = k->step ? (ry_at(x, y) + 1) * luminance : luminance;
    const double blue = k->step ? (by_at(x, y) + 1) * luminance : luminance;
    const double green = (luminance - k->weights[0] * red - k->weights[2] * blue) / k->weights[1];
    const double expected[3] = { red, green, blue };
    for (int c = 0; c < 3; c++)
        if (!(fabs((double)rgb[c] - expected[c]) <= (k->half ? 4e-3 : 2e-4) * luminance))
            fail_msg("step %d, pixel %d, %d: channel %d is %.7g, not %.7g", k->step, x, y, c,
                     (double)rgb[c], expected[c]);
}

static void check(const kind *k) {
    const file f = make(k);
    const image_source source = {
        .path = "input.exr", .data = f.bytes, .size = f.size, .pixels_max = 1 << 20
    };
    image pixels;
    base_error error = { "" };
    if (!image_decode_exr(&source, &pixels, &error))
        fail_msg("%s", error.text);
    assert_int_equal(pixels.width, WIDTH);
    assert_int_equal(pixels.height, HEIGHT);
    const int edge = k->step > 1 ? EDGE : 0; /* where the filter has too few samples */
    for (int y = edge; y < HEIGHT - edge; y++)
        for (int x = edge; x < WIDTH - edge; x++)
            check_pixel(k, x, y, pixels.rgb + 3 * (y * WIDTH + x));
    image_free(&pixels);
}

#define REC709                                                                                     \
    { 0.2126390, 0.7151687, 0.0721923 }

static void an_image_of_luminance_is_gray(void **state) {
    (void)state;
    check(&(kind) { .step = 0, .weights = REC709 });
    check(&(kind) { .step = 0, .half = true, .weights = REC709 });
}

static void luminance_and_chroma_give_colors(void **state) {
    (void)state;
    for (int step = 1; step <= 2; step++)
        for (int half = 0; half < 2; half++)
            check(&(kind) { .step = step, .half = half, .weights = REC709 });
}

/* The weights are Rec. 2020's luminance, as in its standard. */
static void chromaticities_say_what_luminance_is_of(void **state) {
    (void)state;
    static const float rec2020[] = {
        0.708f, 0.292f, 0.17f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.329f
    };
    check(&(kind) {
        .step = 2, .chromaticities = rec2020, .weights = { 0.2627002, 0.6779981, 0.0593017 } });
}

static void a_file_without_any_color_is_refused(void **state) {
    (void)state;
    file f = make(&(kind) { .step = 0 });
    unsigned char *const name = memchr(f.bytes, 'Y', 60);
    assert_non_null(name);
    *name = 'Z';
    const image_source source = {
        .path = "input.exr", .data = f.bytes, .size = f.size, .pixels_max = 1 << 20
    };
    image pixels;
    base_error error = { "" };
    assert_false(image_decode_exr(&source, &pixels, &error));
    assert_string_equal(error.text, "input.exr: needs channels R, G and B, or Y, of half or float");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_image_of_luminance_is_gray),
        cmocka_unit_test(luminance_and_chroma_give_colors),
        cmocka_unit_test(chromaticities_say_what_luminance_is_of),
        cmocka_unit_test(a_file_without_any_color_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
