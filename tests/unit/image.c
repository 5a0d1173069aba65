/* SPDX-License-Identifier: MIT */
/* Images of the surroundings: directions by the formulas that viewers and graphics APIs publish. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Expects the coefficients of one texel of value 1 seen in direction w. */
static void expect_texel(int bands, const double w[3], double solid_angle, double *expected) {
    oracle_sh_eval(bands, w, expected);
    for (int k = 0; k < bands * bands; k++)
        expected[k] *= solid_angle;
}

/* Evaluates a smooth function of 4 bands, by the oracle. */
static double smooth(const double w[3]) {
    double sh[16], sum = 0;
    oracle_sh_eval(4, w, sh);
    for (int k = 0; k < 16; k++)
        sum += sh[k] * (k % 3 - 0.7);
    return sum;
}

static double smooth_error(const float *sh) {
    double expected[16];
    for (int k = 0; k < 16; k++)
        expected[k] = k % 3 - 0.7;
    return check_error(16, expected, sh);
}

/* Converts a float to half, for values that are exact in it. */
static uint16_t half_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint32_t sign = bits >> 16 & 0x8000, mantissa = bits >> 13 & 0x3ff;
    const int exponent = (int)(bits >> 23 & 255) - 112;
    return (uint16_t)(value == 0 ? sign : sign | (uint32_t)exponent << 10 | mantissa);
}

/* --- latitude-longitude ----------------------------------------------------------------------- */

/* Finds the texel that shows direction w, as the shaders of three.js and of glTF's sample viewer
 * look it up: u = atan(z, x) / 2 pi + 1/2, v = acos(y) / pi from the top. */
static void viewers_texel(const double w[3], int width, int height, int *row, int *column) {
    const double u = atan2(w[2], w[0]) / (2 * ORACLE_PI) + 0.5, v = acos(w[1]) / ORACLE_PI;
    *column = (int)fmin(u * width, width - 1);
    *row = (int)fmin(v * height, height - 1);
}

static void texel_center(int width, int height, int row, int column, double w[3]) {
    const double polar = ORACLE_PI * (row + 0.5) / height;
    const double angle = 2 * ORACLE_PI * (column + 0.5) / width - ORACLE_PI;
    w[0] = sin(polar) * cos(angle);
    w[1] = cos(polar);
    w[2] = sin(polar) * sin(angle);
}

static double ring_angle(int width, int height, int row) {
    return (cos(ORACLE_PI * row / height) - cos(ORACLE_PI * (row + 1) / height)) * 2 * ORACLE_PI /
           width;
}

static void a_texel_shines_from_where_viewers_show_it(void **state) {
    (void)state;
    enum { WIDTH = 90, HEIGHT = 45 };
    static float pixels[WIDTH * HEIGHT], sh[36];
    for (int i = 0; i < 20; i++) {
        const lmp_vec3 d = check_random_direction();
        const double looked[3] = { (double)d.x, (double)d.y, (double)d.z };
        double w[3], expected[36];
        int row, column;
        viewers_texel(looked, WIDTH, HEIGHT, &row, &column);
        texel_center(WIDTH, HEIGHT, row, column, w);
        assert_true(w[0] * looked[0] + w[1] * looked[1] + w[2] * looked[2] > 0.99);
        pixels[row * WIDTH + column] = 1;
        lmp_sh_project_latlong(
            6, &(lmp_latlong) { .pixels = pixels, .width = WIDTH, .height = HEIGHT, .channels = 1 },
            sh);
        expect_texel(6, w, ring_angle(WIDTH, HEIGHT, row), expected);
        CHECK_WITHIN(check_error(36, expected, sh), 1e-6);
        pixels[row * WIDTH + column] = 0;
    }
}

static void a_constant_image_is_a_constant(void **state) {
    (void)state;
    enum { WIDTH = 64, HEIGHT = 32 };
    static float pixels[WIDTH * HEIGHT], sh[25];
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        pixels[i] = 0.5f;
    lmp_sh_project_latlong(
        5, &(lmp_latlong) { .pixels = pixels, .width = WIDTH, .height = HEIGHT, .channels = 1 },
        sh);
    CHECK_WITHIN(fabs((double)sh[0] - sqrt(ORACLE_PI)), 1e-6);
    /* The texels' own size remains in the others: of order 1/height². */
    for (int k = 1; k < 25; k++)
        CHECK_WITHIN(fabsf(sh[k]), 1e-2);
    for (int m = -1; m <= 1; m++)
        CHECK_WITHIN(fabsf(sh[LMP_SH_INDEX(1, m)]), 1e-6);
}

/* Azimuth, mirroring and the up axis: the texel of w in the plain image shows another direction. */
static void options_of_a_latlong_image_move_its_directions(void **state) {
    (void)state;
    enum { WIDTH = 40, HEIGHT = 20, ROW = 6, COLUMN = 27 };
    static float pixels[WIDTH * HEIGHT], sh[25];
    double w[3], expected[25];
    const float azimuth = 0.7f;
    texel_center(WIDTH, HEIGHT, ROW, COLUMN, w);
    pixels[ROW * WIDTH + COLUMN] = 1;
    lmp_latlong map = { .pixels = pixels, .width = WIDTH, .height = HEIGHT, .channels = 1 };
    const double c = cos((double)azimuth), s = sin((double)azimuth);
    const double rotated[3] = { c * w[0] - s * w[2], w[1], s * w[0] + c * w[2] };
    const double mirrored[3] = { w[0], w[1], -w[2] }, z_up[3] = { w[0], -w[2], w[1] };
    const double angle = ring_angle(WIDTH, HEIGHT, ROW);
    map.azimuth = azimuth;
    lmp_sh_project_latlong(5, &map, sh);
    expect_texel(5, rotated, angle, expected);
    CHECK_WITHIN(check_error(25, expected, sh), 1e-6);
    map.azimuth = 0;
    map.mirrored = true;
    lmp_sh_project_latlong(5, &map, sh);
    expect_texel(5, mirrored, angle, expected);
    CHECK_WITHIN(check_error(25, expected, sh), 1e-6);
    map.mirrored = false;
    map.z_up = true;
    lmp_sh_project_latlong(5, &map, sh);
    expect_texel(5, z_up, angle, expected);
    CHECK_WITHIN(check_error(25, expected, sh), 1e-6);
}

/* Six channels with padded rows, planar and interleaved, float and half, give the same
 * coefficients. */
static void texels_are_read_by_their_strides(void **state) {
    (void)state;
    enum { WIDTH = 16, HEIGHT = 8, CHANNELS = 6, TEXELS = WIDTH * HEIGHT };
    static float rows[HEIGHT][WIDTH * CHANNELS + 5], planes[CHANNELS][TEXELS];
    static uint16_t halves[TEXELS][CHANNELS];
    float expected[CHANNELS * 9], sh[CHANNELS * 9];
    for (int i = 0; i < TEXELS; i++)
        for (int c = 0; c < CHANNELS; c++) {
            const float value = (float)((i * 7 + c * 13) % 32) / 8 - 2;
            rows[i / WIDTH][i % WIDTH * CHANNELS + c] = planes[c][i] = value;
            halves[i][c] = half_of(value);
        }
    const lmp_latlong padded = { .pixels = rows,
                                 .width = WIDTH,
                                 .height = HEIGHT,
                                 .channels = CHANNELS,
                                 .row_stride = sizeof rows[0] };
    const lmp_latlong planar = { .pixels = planes,
                                 .width = WIDTH,
                                 .height = HEIGHT,
                                 .channels = CHANNELS,
                                 .texel_stride = sizeof(float),
                                 .channel_stride = sizeof planes[0] };
    const lmp_latlong half = { .pixels = halves,
                               .width = WIDTH,
                               .height = HEIGHT,
                               .channels = CHANNELS,
                               .texel = LMP_TEXEL_HALF };
    lmp_sh_project_latlong(3, &padded, expected);
    assert_true(expected[11] != expected[2]);
    lmp_sh_project_latlong(3, &planar, sh);
    assert_memory_equal(sh, expected, sizeof sh);
    lmp_sh_project_latlong(3, &half, sh);
    assert_memory_equal(sh, expected, sizeof sh);
}

static void halves_of_every_size_are_read(void **state) {
    (void)state;
    const uint16_t halves[] = { 0x0001, 0x03ff, 0x0400, 0x3c00, 0x7bff, 0xc000 };
    const double values[] = { 0x1p-24, 1023 * 0x1p-24, 0x1p-14, 1, 65504, -2 };
    for (int i = 0; i < 6; i++) {
        float sh[1];
        const lmp_latlong map = {
            .pixels = &halves[i], .width = 1, .height = 1, .channels = 1, .texel = LMP_TEXEL_HALF
        };
        lmp_sh_project_latlong(1, &map, sh);
        CHECK_WITHIN(fabs((double)sh[0] / (values[i] * sqrt(4 * ORACLE_PI)) - 1), 1e-6);
    }
    const uint16_t infinite = 0x7c00, not_a_number = 0x7e00;
    float sh[1];
    lmp_latlong map = {
        .pixels = &infinite, .width = 1, .height = 1, .channels = 1, .texel = LMP_TEXEL_HALF
    };
    lmp_sh_project_latlong(1, &map, sh);
    assert_true(isinf(sh[0]));
    map.pixels = &not_a_number;
    lmp_sh_project_latlong(1, &map, sh);
    assert_true(isnan(sh[0]));
}

/* --- cube maps -------------------------------------------------------------------------------- */

/* Finds the face of direction w and the position on it, in 0 … 1: table 8.19 of the OpenGL 4.6
 * specification. */
static int specified_face(const double w[3], double *s, double *t) {
    const double x = fabs(w[0]), y = fabs(w[1]), z = fabs(w[2]);
    double sc, tc, ma;
    int face;
    if (x >= y && x >= z) {
        face = w[0] > 0 ? 0 : 1;
        sc = w[0] > 0 ? -w[2] : w[2], tc = -w[1], ma = x;
    } else if (y >= z) {
        face = w[1] > 0 ? 2 : 3;
        sc = w[0], tc = w[1] > 0 ? w[2] : -w[2], ma = y;
    } else {
        face = w[2] > 0 ? 4 : 5;
        sc = w[2] > 0 ? w[0] : -w[0], tc = -w[1], ma = z;
    }
    *s = (sc / ma + 1) / 2;
    *t = (tc / ma + 1) / 2;
    return face;
}

/* Draws a cube map of `size` texels a side that shows smooth() by the specification, by brute
 * force: each texel is the mean over the directions that are looked up in it. */
static void draw_cube(int size, bool left_handed, float *texels, float *counts) {
    const int steps = 6 * size;
    for (int i = 0; i < 6 * size * size; i++)
        texels[i] = counts[i] = 0;
    for (int i = 0; i < steps; i++)
        for (int j = 0; j < 2 * steps; j++) {
            const double polar = ORACLE_PI * (i + 0.5) / steps, phi = ORACLE_PI * (j + 0.5) / steps;
            const double w[3] = { sin(polar) * cos(phi), sin(polar) * sin(phi), cos(polar) };
            const double world[3] = { w[0], w[1], left_handed ? -w[2] : w[2] };
            double s, t;
            const int face = specified_face(w, &s, &t);
            const int column = (int)fmin(s * size, size - 1), row = (int)fmin(t * size, size - 1);
            texels[(face * size + row) * size + column] += (float)smooth(world);
            counts[(face * size + row) * size + column] += 1;
        }
    for (int i = 0; i < 6 * size * size; i++)
        texels[i] /= counts[i];
}

static void cube_maps_have_the_faces_of_the_specification(void **state) {
    (void)state;
    enum { SIZE = 64 };
    static float texels[6 * SIZE * SIZE], counts[6 * SIZE * SIZE], sh[16];
    for (int left_handed = 0; left_handed < 2; left_handed++) {
        lmp_cubemap map = { .size = SIZE, .channels = 1, .left_handed = left_handed };
        draw_cube(SIZE, left_handed, texels, counts);
        for (int face = 0; face < 6; face++)
            map.faces[face] = texels + face * SIZE * SIZE;
        lmp_sh_project_cubemap(4, &map, sh);
        CHECK_WITHIN(smooth_error(sh), 1e-3);
    }
}

static void the_solid_angles_of_a_cube_are_exact(void **state) {
    (void)state;
    enum { LARGE = 2048 };
    float *texels = malloc(sizeof(float) * LARGE * LARGE);
    assert_non_null(texels);
    for (int i = 0; i < LARGE * LARGE; i++)
        texels[i] = 1;
    const int sizes[] = { 1, 2, 3, 65, LARGE };
    for (int i = 0; i < 5; i++) {
        float sh[4];
        const lmp_cubemap map = { .faces = { texels, texels, texels, texels, texels, texels },
                                  .size = sizes[i],
                                  .channels = 1 };
        lmp_sh_project_cubemap(2, &map, sh);
        CHECK_WITHIN(fabs((double)sh[0] / sqrt(4 * ORACLE_PI) - 1), 2e-7);
        for (int k = 1; k < 4; k++)
            CHECK_WITHIN(fabsf(sh[k]), 1e-6);
    }
    free(texels);
}

/* One texel of each face is compared with its solid angle by quadrature over it. */
static void a_texel_of_a_cube_weighs_its_solid_angle(void **state) {
    (void)state;
    enum { SIZE = 5 };
    static float texels[SIZE * SIZE], dark[SIZE * SIZE];
    double nodes[12], weights[12];
    oracle_gauss_legendre(12, nodes, weights);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double u = (i % SIZE + 0.5) * 2 / SIZE - 1, v = (i / SIZE + 0.5) * 2 / SIZE - 1;
        double solid_angle = 0, expected[25];
        for (int a = 0; a < 144; a++) {
            const double x = u + nodes[a % 12] / SIZE, y = v + nodes[a / 12] / SIZE;
            solid_angle += weights[a % 12] * weights[a / 12] / pow(1 + x * x + y * y, 1.5);
        }
        float sh[25];
        const lmp_cubemap map = { .faces = { dark, dark, dark, dark, texels, dark },
                                  .size = SIZE,
                                  .channels = 1 };
        texels[i] = 1;
        lmp_sh_project_cubemap(5, &map, sh);
        texels[i] = 0;
        /* face +z: columns along x, rows along -y */
        expect_texel(5, (const double[3]) { u, -v, 1 }, solid_angle / (SIZE * SIZE), expected);
        CHECK_WITHIN(check_error(25, expected, sh), 1e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_texel_shines_from_where_viewers_show_it),
        cmocka_unit_test(a_constant_image_is_a_constant),
        cmocka_unit_test(options_of_a_latlong_image_move_its_directions),
        cmocka_unit_test(texels_are_read_by_their_strides),
        cmocka_unit_test(halves_of_every_size_are_read),
        cmocka_unit_test(cube_maps_have_the_faces_of_the_specification),
        cmocka_unit_test(the_solid_angles_of_a_cube_are_exact),
        cmocka_unit_test(a_texel_of_a_cube_weighs_its_solid_angle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
