/* SPDX-License-Identifier: MIT */
/* Textures and lobes of the ground truth against closed forms. */
#include "app/scene/texture_at.h"
#include "app/truth/reference_lobe.h"
#include "tests/oracle/check.h"

#include <math.h>

enum { COLUMNS = 4, ROWS = 3 };

static unsigned char texels[4 * COLUMNS * ROWS];
static scene_texture texture;
static scene_texture_use use;
static scene world;

/* Returns the bilinear value between the centers of texels, for each channel, in 0 … 1. */
static double channel_at(double column, double row, int c) {
    const double scale = 1 / 255.0;
    return scale * (10 + c + (20 + c) * column + (30 + 2 * c) * row + (5 + c) * column * row);
}

static void paint(uint32_t srgb) {
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++)
            for (int c = 0; c < 4; c++)
                texels[4 * (COLUMNS * row + column) + c] =
                    (unsigned char)lround(255 * channel_at(column, row, c));
    texture = (scene_texture) { .width = COLUMNS,
                                .height = ROWS,
                                .srgb = srgb,
                                .wrap_u = SCENE_WRAP_CLAMP,
                                .wrap_v = SCENE_WRAP_CLAMP };
    use = (scene_texture_use) { .texture = 0, .matrix = { 1, 0, 0, 1 } };
    world = (scene) { .textures = &texture, .texels = texels, .texture_count = 1 };
}

/* Reads at a position that counts from the center of the first texel, as channel_at does. */
static void read_at(double column, double row, double rgba[4]) {
    const double uv[2] = { (column + 0.5) / COLUMNS, (row + 0.5) / ROWS };
    texture_at(&world, &use, uv, rgba);
}

static void expect_at(double column, double row, double seen_column, double seen_row) {
    double rgba[4];
    read_at(column, row, rgba);
    for (int c = 0; c < 4; c++)
        CHECK_WITHIN(fabs(rgba[c] - channel_at(seen_column, seen_row, c)), 1e-12);
}

static void between_texels_a_texture_is_bilinear(void **state) {
    (void)state;
    paint(0);
    for (double row = 0; row <= ROWS - 1; row += 0.125)
        for (double column = 0; column <= COLUMNS - 1; column += 0.125)
            expect_at(column, row, column, row);
}

static void each_way_to_wrap_goes_on_as_it_should(void **state) {
    (void)state;
    paint(0);
    expect_at(-3, 1, 0, 1);
    expect_at(9, 7, COLUMNS - 1, ROWS - 1);
    texture.wrap_u = texture.wrap_v = SCENE_WRAP_REPEAT;
    expect_at(-1, 0, COLUMNS - 1, 0);
    expect_at(COLUMNS, ROWS + 1, 0, 1);
    expect_at(-2 * COLUMNS + 1, -ROWS, 1, 0);
    texture.wrap_u = texture.wrap_v = SCENE_WRAP_MIRROR;
    expect_at(-1, -2, 0, 1);
    expect_at(COLUMNS, ROWS + 1, COLUMNS - 1, ROWS - 2);
    expect_at(2 * COLUMNS + 1, 0, 1, 0);
}

static void repeated_textures_blend_across_their_edge(void **state) {
    (void)state;
    double rgba[4];
    paint(0);
    texture.wrap_u = SCENE_WRAP_REPEAT;
    read_at(COLUMNS - 0.75, 1, rgba);
    for (int c = 0; c < 4; c++)
        CHECK_WITHIN(
            fabs(rgba[c] - 0.75 * channel_at(COLUMNS - 1, 1, c) - 0.25 * channel_at(0, 1, c)),
            1e-12);
}

/* Colors follow IEC 61966-2-1; alpha is linear. */
static void colors_are_decoded_before_they_blend(void **state) {
    (void)state;
    double rgba[4], linear[2];
    paint(1);
    for (int c = 0; c < 4; c++) {
        for (int i = 0; i < 2; i++) {
            const double v = channel_at(i, 0, c);
            linear[i] = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
            linear[i] = c == 3 ? v : linear[i];
        }
        read_at(0.25, 0, rgba);
        CHECK_WITHIN(fabs(rgba[c] - 0.75 * linear[0] - 0.25 * linear[1]), 1e-12);
    }
}

/* The transform is a quarter turn, a scale of 1/2 and an offset. */
static void coordinates_are_transformed_first(void **state) {
    (void)state;
    double moved[4], plain[4];
    paint(0);
    const double uv[2] = { 0.3, 0.8 }, expected[2] = { -0.4 + 0.9, 0.15 + 0.25 };
    texture_at(&world, &use, expected, plain);
    use = (scene_texture_use) { 0, { 0, -0.5f, 0.5f, 0 }, { 0.9f, 0.25f }, 0 };
    texture_at(&world, &use, uv, moved);
    for (int c = 0; c < 4; c++)
        CHECK_WITHIN(fabs(moved[c] - plain[c]), 1e-6);
    use.texture = -1;
    texture_at(&world, &use, uv, moved);
    for (int c = 0; c < 4; c++)
        assert_true(moved[c] == 1);
}

/* --- lobes ------------------------------------------------------------------------------------ */

/* Along a row or a column the texture is linear, and its mean that at the triangle's middle,
 * however finely the triangle is divided. */
static void the_mean_over_a_triangle_is_that_of_its_middle(void **state) {
    (void)state;
    static const double ends[][3] = { { 0, 3, 1 }, { 2.5, 2.25, 3 }, { 1, 1, 1.001 } };
    paint(0);
    for (int k = 0; k < 6; k++) {
        const double *at = ends[k / 2], middle = (at[0] + at[1] + at[2]) / 3;
        const bool rows = k % 2; /* two thirds as far */
        double uv[3][2], rgba[4];
        for (int i = 0; i < 3; i++) {
            uv[i][0] = ((rows ? 0 : at[i]) + 0.5) / COLUMNS;
            uv[i][1] = ((rows ? at[i] * 2 / 3 : 0) + 0.5) / ROWS;
        }
        texture_mean_at(&world, &use, uv, rgba);
        for (int c = 0; c < 4; c++)
            CHECK_WITHIN(
                fabs(rgba[c] - channel_at(rows ? 0 : middle, rows ? middle * 2 / 3 : 0, c)), 1e-12);
    }
    double uv[3][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 } }, rgba[4];
    use.texture = -1;
    texture_mean_at(&world, &use, uv, rgba);
    assert_true(rgba[0] == 1 && rgba[3] == 1);
}

static void lobes_have_the_value_of_their_definition(void **state) {
    (void)state;
    static const double exponents[] = { 0, 0.5, 1, 2, 30, 1000 };
    for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++) {
        const reference_lobe lobe = { .exponent = exponents[i] };
        for (double cosine = -1; cosine <= 1; cosine += 0.0625) {
            const double e = exponents[i], pi = 3.14159265358979324;
            const double expected = cosine > 0 ? (e + 1) / (2 * pi) * exp(e * log(cosine)) : 0;
            CHECK_WITHIN(fabs(reference_lobe_at(&lobe, cosine) - expected), 1e-9 * (1 + expected));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(between_texels_a_texture_is_bilinear),
        cmocka_unit_test(each_way_to_wrap_goes_on_as_it_should),
        cmocka_unit_test(repeated_textures_blend_across_their_edge),
        cmocka_unit_test(colors_are_decoded_before_they_blend),
        cmocka_unit_test(coordinates_are_transformed_first),
        cmocka_unit_test(the_mean_over_a_triangle_is_that_of_its_middle),
        cmocka_unit_test(lobes_have_the_value_of_their_definition),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
