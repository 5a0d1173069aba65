/* SPDX-License-Identifier: MIT */
/* Metrics of hand-made images. */
#include "app/image/compare.h"
#include "app/image/flip.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 16, HEIGHT = 12, VALUES = 3 * WIDTH * HEIGHT };

typedef struct pair {
    float a_values[VALUES], b_values[VALUES];
    image a, b;
} pair;

/* Makes two equal images with values in 0 … 1, of which the largest is 1. */
static void make_pair(pair *p) {
    for (int i = 0; i < VALUES; i++)
        p->a_values[i] = p->b_values[i] = (float)((i * 37) % 101) / 100;
    p->a = (image) { WIDTH, HEIGHT, p->a_values };
    p->b = (image) { WIDTH, HEIGHT, p->b_values };
}

static compare_result compare(const pair *p, double peak) {
    compare_result result;
    base_error error;
    assert_true(compare_images(&p->a, &p->b, peak, &result, &error));
    return result;
}

static void equal_images_have_no_difference(void **state) {
    (void)state;
    pair p;
    make_pair(&p);
    const compare_result r = compare(&p, 0);
    assert_true(r.values[COMPARE_RMSE] == 0 && r.values[COMPARE_RELMSE] == 0);
    assert_true(r.values[COMPARE_MAX] == 0 && isinf(r.values[COMPARE_PSNR]));
    CHECK_WITHIN(fabs(r.values[COMPARE_SSIM] - 1), 1e-12);
    assert_true(r.bad_values == 0);
}

static void one_changed_value_gives_the_metrics_by_hand(void **state) {
    (void)state;
    pair p;
    make_pair(&p);
    const int at = 3 * (5 * WIDTH + 7) + 2;
    p.b_values[at] = 0.5f;
    p.a_values[at] = 0.75f;
    const compare_result r = compare(&p, 0);
    CHECK_WITHIN(fabs(r.values[COMPARE_RMSE] - sqrt(0.0625 / VALUES)), 1e-12);
    CHECK_WITHIN(fabs(r.values[COMPARE_RELMSE] - 0.0625 / 0.26 / VALUES), 1e-12);
    CHECK_WITHIN(fabs(r.values[COMPARE_PSNR] - 10 * log10(VALUES / 0.0625)), 1e-9);
    CHECK_WITHIN(fabs(r.values[COMPARE_MAX] - 0.25), 1e-12);
    assert_int_equal(r.max_x, 7);
    assert_int_equal(r.max_y, 5);
}

static void the_first_of_equal_differences_is_named(void **state) {
    (void)state;
    pair p;
    make_pair(&p);
    for (int i = 0; i < VALUES; i++) {
        p.a_values[i] = 1;
        p.b_values[i] = i / 3 == 2 * WIDTH + 3 || i / 3 == 4 * WIDTH + 1 ? 0.5f : 1;
    }
    const compare_result r = compare(&p, 0);
    assert_true(r.max_x == 3 && r.max_y == 2);
}

static void the_peak_scales_psnr(void **state) {
    (void)state;
    pair p;
    make_pair(&p);
    p.a_values[0] += 0.1f;
    CHECK_WITHIN(
        fabs(compare(&p, 10).values[COMPARE_PSNR] - compare(&p, 1).values[COMPARE_PSNR] - 20),
        1e-9);
}

/* A constant offset leaves contrast and structure: SSIM is the luminance term alone. */
static void ssim_of_an_offset_is_the_luminance_term(void **state) {
    (void)state;
    pair p;
    make_pair(&p);
    for (int i = 0; i < VALUES; i++) {
        p.b_values[i] = 0.5f;
        p.a_values[i] = 0.75f;
    }
    const double c1 = 1e-4, expected = (2 * 0.5 * 0.75 + c1) / (0.25 + 0.5625 + c1);
    CHECK_WITHIN(fabs(compare(&p, 1).values[COMPARE_SSIM] - expected), 1e-9);
    for (int i = 0; i < VALUES; i++)
        p.a_values[i] = (float)((i / 3 * 7) % 2), p.b_values[i] = 1 - p.a_values[i];
    assert_true(compare(&p, 1).values[COMPARE_SSIM] < -0.5); /* inverted structure */
}

/* Computes SSIM by its definition, pixel by pixel: a window of 11 x 11, sigma 1.5, cut at the
 * edges; peak 1. */
static double ssim_by_hand(const image *a_image, const image *b_image) {
    const double c1 = 1e-4, c2 = 9e-4;
    const int width = a_image->width, height = a_image->height;
    double all = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double weights = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
            for (int j = y < 5 ? 0 : y - 5; j < height && j <= y + 5; j++)
                for (int i = x < 5 ? 0 : x - 5; i < width && i <= x + 5; i++) {
                    const int dx = i - x, dy = j - y;
                    const double w = exp(-(dx * dx + dy * dy) / 4.5);
                    const double u = (double)a_image->rgb[3 * (width * j + i)];
                    const double v = (double)b_image->rgb[3 * (width * j + i)];
                    weights += w, a += w * u, b += w * v;
                    aa += w * u * u, bb += w * v * v, ab += w * u * v;
                }
            a /= weights, b /= weights;
            const double covariance = ab / weights - a * b;
            all += (2 * a * b + c1) * (2 * covariance + c2) / (a * a + b * b + c1) /
                   (aa / weights - a * a + bb / weights - b * b + c2);
        }
    return all / (width * height);
}

/* The images are gray, because luminance is not tested here; their sizes lie on both sides of those
 * that are processed at once. */
static void ssim_of_noise_is_that_of_its_definition(void **state) {
    (void)state;
    static const int sizes[][2] = { { WIDTH, HEIGHT }, { 1, 1 },   { 3, 63 },  { 5, 64 },
                                    { 4, 65 },         { 17, 70 }, { 2, 133 }, { 90, 3 } };
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        image a, b;
        base_error error;
        compare_result result;
        assert_true(image_create(&a, sizes[k][0], sizes[k][1], &error));
        assert_true(image_create(&b, sizes[k][0], sizes[k][1], &error));
        for (int i = 0; i < 3 * a.width * a.height; i++) {
            a.rgb[i] = (float)((i / 3 * 37) % 101) / 100;
            b.rgb[i] = (float)((i / 3 * 53) % 97) / 96;
        }
        assert_true(compare_images(&a, &b, 1, &result, &error));
        CHECK_WITHIN(fabs(result.values[COMPARE_SSIM] - ssim_by_hand(&a, &b)), 1e-7);
        image_free(&a);
        image_free(&b);
    }
}

static void bad_values_poison_every_metric(void **state) {
    (void)state;
    const float bad[] = { NAN, INFINITY, -INFINITY };
    for (int i = 0; i < 6; i++) {
        pair p;
        make_pair(&p);
        (i % 2 ? p.a_values : p.b_values)[3 * (WIDTH * 3 + 4) + 1] = bad[i / 2];
        const compare_result r = compare(&p, 0);
        for (int m = 0; m < COMPARE_COUNT; m++)
            assert_true(isnan(r.values[m]));
        assert_int_equal(r.bad_values, 1);
        assert_true(r.max_x == 4 && r.max_y == 3);
    }
}

static void different_sizes_are_refused(void **state) {
    (void)state;
    pair p;
    compare_result result;
    base_error error;
    make_pair(&p);
    p.b.height--;
    assert_false(compare_images(&p.a, &p.b, 0, &result, &error));
    assert_non_null(strstr(error.text, "16x12 and 16x11"));
}

static void a_heat_map_goes_from_black_to_white_and_marks_bad_values(void **state) {
    (void)state;
    pair p;
    unsigned char rgb8[VALUES];
    make_pair(&p);
    p.a_values[3] += 0.5f;
    p.a_values[6] += 0.25f;
    p.a_values[9] = NAN;
    compare_heat_map(&p.a, &p.b, 0, rgb8);
    assert_true(rgb8[0] == 0 && rgb8[1] == 0 && rgb8[2] == 0);
    assert_true(rgb8[3] == 255 && rgb8[4] == 255);
    assert_true(rgb8[6] > 100 && rgb8[6] < 255);
    assert_true(rgb8[9] == 0 && rgb8[10] == 255 && rgb8[11] == 0);
}

/* 192 pixels of which the k-th differs by k/256: 99 % are the first 191. */
static void a_percentile_is_what_so_many_pixels_do_not_exceed(void **state) {
    (void)state;
    pair p;
    double value;
    memset(&p, 0, sizeof p);
    p.a = (image) { WIDTH, HEIGHT, p.a_values };
    p.b = (image) { WIDTH, HEIGHT, p.b_values };
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        p.a_values[3 * ((i * 7) % (WIDTH * HEIGHT))] = (float)(i + 1) / 256;
    const double percents[] = { 99, 100, 50, 1 }, expected[] = { 191, 192, 96, 2 };
    for (int i = 0; i < 4; i++) {
        assert_true(compare_difference_percentile(&p.a, &p.b, percents[i], &value));
        CHECK_WITHIN(fabs(value - expected[i] / 256), 1e-12);
    }
    for (int i = 0; i < VALUES; i++)
        p.a_values[i] = NAN;
    assert_true(compare_difference_percentile(&p.a, &p.b, 99, &value));
    assert_true(value == 0);
}

static void display_values_are_srgb(void **state) {
    (void)state;
    float values[6] = { 0, 0.002f, 0.214041f, 1, 3, -1 };
    const float expected[6] = { 0, 0.02584f, 0.5f, 1, 1, 0 };
    image pixels = { 2, 1, values };
    compare_to_display(&pixels);
    for (int i = 0; i < 6; i++)
        CHECK_WITHIN(fabsf(values[i] - expected[i]), 1e-5);
}

/* One color against another, without any edge: the paper's steps by hand for black against white,
 * whose distance is 100 in lightness. */
static void flip_of_flat_images_is_that_of_their_colors(void **state) {
    (void)state;
    pair p;
    double flip;
    make_pair(&p);
    for (int i = 0; i < VALUES; i++) {
        p.a_values[i] = 0;
        p.b_values[i] = 1;
    }
    assert_true(compare_flip(&p.a, &p.b, &flip));
    const double largest = pow(203.36, 0.7), part = pow(100, 0.7) / largest;
    CHECK_WITHIN(fabs(flip - (0.95 + 0.05 * (part - 0.4) / 0.6)), 1e-4);
    assert_true(compare_flip(&p.a, &p.a, &flip));
    assert_true(flip == 0);
}

/* Converts a display color to L*a*b*, D65, with Hunt's adjustment. */
static void lab_of(const float rgb[3], double lab[3]) {
    static const double from_rgb[3][3] = { { 0.4124564, 0.3575761, 0.1804375 },
                                           { 0.2126729, 0.7151522, 0.0721750 },
                                           { 0.0193339, 0.1191920, 0.9503041 } };
    double f[3];
    for (int k = 0; k < 3; k++) {
        double sum = 0, white = 0;
        for (int i = 0; i < 3; i++) {
            const double v = (double)rgb[i];
            sum += from_rgb[k][i] * (v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
            white += from_rgb[k][i];
        }
        const double t = sum / white;
        f[k] = t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 5 * lab[0] * (f[0] - f[1]);
    lab[2] = 2 * lab[0] * (f[1] - f[2]);
}

static double color_distance(const float a[3], const float b[3]) {
    double u[3], v[3];
    lab_of(a, u);
    lab_of(b, v);
    return fabs(u[0] - v[0]) + hypot(u[1] - v[1], u[2] - v[2]);
}

/* Returns the paper's scale of a distance: 0.95 for 0.4 of the distance between green and blue, the
 * largest. */
static double color_part(double distance) {
    const float green[3] = { 0, 1, 0 }, blue[3] = { 0, 0, 1 };
    const double part = pow(distance / color_distance(green, blue), 0.7);
    return part < 0.4 ? 0.95 / 0.4 * part : 0.95 + 0.05 * (part - 0.4) / 0.6;
}

static void flip_of_two_colors_is_their_distance(void **state) {
    (void)state;
    static const float colors[][3] = { { 0.5f, 0.5f, 0.5f }, { 0.6f, 0.5f, 0.4f },
                                       { 0.2f, 0.7f, 0.3f }, { 0.25f, 0.6f, 0.45f },
                                       { 0.7f, 0.3f, 0.6f }, { 0.55f, 0.45f, 0.9f } };
    enum { COLORS = sizeof colors / sizeof *colors };
    pair p;
    make_pair(&p);
    for (int k = 0; k < COLORS * COLORS; k++) {
        const float *a = colors[k / COLORS], *b = colors[k % COLORS];
        double flip;
        for (int i = 0; i < VALUES; i++) {
            p.a_values[i] = a[i % 3];
            p.b_values[i] = b[i % 3];
        }
        assert_true(compare_flip(&p.a, &p.b, &flip));
        CHECK_WITHIN(fabs(flip - color_part(color_distance(a, b))), 2e-4);
    }
}

/* Returns the paper's kernels in two dimensions, 67.02 pixels a degree: where k is 0 the eye's
 * sharpness, then an edge and a point, across or along. */
static double kernel_at(int k, double x, double y) {
    const double pi = acos(-1), sigma = 0.5 * 0.082 * 67.02, square = sigma * sigma;
    const double degrees2 = (x * x + y * y) / (67.02 * 67.02);
    if (k == 0)
        return exp(-pi * pi * degrees2 / 0.0047);
    if (fmax(fabs(x), fabs(y)) > ceil(3 * sigma))
        return 0;
    const double g = exp(-(x * x + y * y) / (2 * square)), along = k % 2 ? x : y;
    return k < 3 ? -along * g : (along * along / square - 1) * g;
}

/* Returns a gray image at a pixel through a kernel whose positive and negative weights sum to 1;
 * the image continues past its sides. */
static double filtered(const double *gray, int x, int y, int k) {
    double sums[2] = { 0, 0 }, weights[2] = { 0, 0 };
    for (int j = -10; j <= 10; j++)
        for (int i = -10; i <= 10; i++) {
            const int column = x + i < 0 ? 0 : x + i < WIDTH ? x + i : WIDTH - 1;
            const int row = y + j < 0 ? 0 : y + j < HEIGHT ? y + j : HEIGHT - 1;
            const double weight = kernel_at(k, i, j);
            sums[weight < 0] += weight * gray[row * WIDTH + column];
            weights[weight < 0] += fabs(weight);
        }
    return sums[0] / weights[0] + (weights[1] > 0 ? sums[1] / weights[1] : 0);
}

typedef struct flip_features {
    double lightness, edge, point;
} flip_features;

static flip_features features_of(const double *gray, int x, int y) {
    const double t = filtered(gray, x, y, 0);
    return (flip_features) { 116 * (t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116) -
                                 16,
                             hypot(filtered(gray, x, y, 1), filtered(gray, x, y, 2)),
                             hypot(filtered(gray, x, y, 3), filtered(gray, x, y, 4)) };
}

static void flip_of_gray_images_is_that_of_its_definition(void **state) {
    (void)state;
    pair p;
    double gray[2][WIDTH * HEIGHT], flip, expected = 0;
    make_pair(&p);
    for (int i = 0; i < VALUES; i++) {
        p.a_values[i] = 0.2f + 0.6f * (float)((i / 3 * 37) % 101) / 100;
        p.b_values[i] = i / 3 % WIDTH < 6 ? 0.35f : 0.65f;
    }
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        for (int k = 0; k < 2; k++)
            gray[k][i] = pow(((double)(k ? p.b_values : p.a_values)[3 * i] + 0.055) / 1.055, 2.4);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const flip_features a = features_of(gray[0], i % WIDTH, i / WIDTH);
        const flip_features b = features_of(gray[1], i % WIDTH, i / WIDTH);
        const double feature = fmax(fabs(a.edge - b.edge), fabs(a.point - b.point));
        expected += pow(color_part(fabs(a.lightness - b.lightness)), 1 - sqrt(feature / sqrt(2)));
    }
    assert_true(compare_flip(&p.a, &p.b, &flip));
    CHECK_WITHIN(fabs(flip - expected / (WIDTH * HEIGHT)), 1e-4);
}

/* A line of another gray differs by more than its color: what an edge adds does not vanish with the
 * difference of lightness, and both grow. */
static void flip_grows_with_a_line_in_a_gray_image(void **state) {
    (void)state;
    pair p;
    double before = 0;
    make_pair(&p);
    for (int step = 1; step <= 4; step++) {
        double flip, swapped;
        for (int i = 0; i < VALUES; i++) {
            p.a_values[i] = 0.5f;
            p.b_values[i] = i / 3 % WIDTH == WIDTH / 2 ? 0.5f + 0.1f * (float)step : 0.5f;
        }
        assert_true(compare_flip(&p.a, &p.b, &flip));
        assert_true(compare_flip(&p.b, &p.a, &swapped));
        assert_true(flip > before + 0.01 && flip < 1);
        CHECK_WITHIN(fabs(flip - swapped), 1e-12);
        before = flip;
    }
}

static void what_is_shown_is_judged(void **state) {
    (void)state;
    pair p;
    base_error error;
    make_pair(&p);
    compare_result r = compare(&p, 1);
    assert_true(isnan(r.values[COMPARE_SHOWN]) && isnan(r.values[COMPARE_FLIP]));
    assert_true(compare_shown(&p.a, &p.b, &r, &error));
    CHECK_WITHIN(fabs(r.values[COMPARE_SHOWN] - 1), 1e-12);
    assert_true(r.values[COMPARE_FLIP] == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_images_have_no_difference),
        cmocka_unit_test(one_changed_value_gives_the_metrics_by_hand),
        cmocka_unit_test(the_first_of_equal_differences_is_named),
        cmocka_unit_test(the_peak_scales_psnr),
        cmocka_unit_test(flip_of_flat_images_is_that_of_their_colors),
        cmocka_unit_test(flip_of_two_colors_is_their_distance),
        cmocka_unit_test(flip_of_gray_images_is_that_of_its_definition),
        cmocka_unit_test(flip_grows_with_a_line_in_a_gray_image),
        cmocka_unit_test(what_is_shown_is_judged),
        cmocka_unit_test(ssim_of_an_offset_is_the_luminance_term),
        cmocka_unit_test(ssim_of_noise_is_that_of_its_definition),
        cmocka_unit_test(bad_values_poison_every_metric),
        cmocka_unit_test(different_sizes_are_refused),
        cmocka_unit_test(a_percentile_is_what_so_many_pixels_do_not_exceed),
        cmocka_unit_test(a_heat_map_goes_from_black_to_white_and_marks_bad_values),
        cmocka_unit_test(display_values_are_srgb),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
