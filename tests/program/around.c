/* SPDX-License-Identifier: MIT */
/* Directions drawn from an environment, against the map of it that its format defines: rows of
 * equal angles from the top, columns of equal angles, their middle at the azimuth. */
#include "app/render/shadow/around.h"

#include "tests/oracle/check.h"

#include <math.h>

enum { WIDTH = 7, HEIGHT = 5, TEXELS = WIDTH * HEIGHT, STEPS = 256 };

static float rgb[TEXELS][3];
static environment sky = { .light = { WIDTH, HEIGHT, rgb[0] }, .azimuth = 0.7f };
static const double pi = 3.14159265358979323846;

/* Every texel its own color, some black, one a sun. */
static void color(void) {
    for (int i = 0; i < TEXELS; i++)
        for (int c = 0; c < 3; c++)
            rgb[i][c] = i % 5 == 3 ? 0 : (float)check_random_between(0.1, 1 + c);
    rgb[11][0] = 50;
}

/* Of a row's texel: a part of the belt between two cosines. */
static double solid_angle(int row) {
    return 2 * pi / WIDTH * (cos(pi * row / HEIGHT) - cos(pi * (row + 1) / HEIGHT));
}

static int texel_at(lmp_vec3 d) {
    const double down = acos(fmin(fmax((double)d.y, -1), 1)) / pi;
    double turns = (atan2((double)d.z, (double)d.x) - (double)sky.azimuth) / (2 * pi) + 0.5;
    turns -= floor(turns);
    const int row = (int)(down * HEIGHT), column = (int)(turns * WIDTH);
    return (row < HEIGHT ? row : HEIGHT - 1) * WIDTH + (column < WIDTH ? column : WIDTH - 1);
}

static void the_mean_is_that_of_all_directions(void **state) {
    (void)state;
    shadow_around around;
    double mean[3] = { 0, 0, 0 };
    color();
    for (int i = 0; i < TEXELS; i++)
        for (int c = 0; c < 3; c++)
            mean[c] += (double)rgb[i][c] * solid_angle(i / WIDTH) / (4 * pi);
    assert_true(shadow_around_create(&sky, &around));
    assert_true(shadow_around_shines(&around));
    CHECK_WITHIN(fabs((double)around.mean.r / mean[0] - 1), 1e-6);
    CHECK_WITHIN(fabs((double)around.mean.g / mean[1] - 1), 1e-6);
    CHECK_WITHIN(fabs((double)around.mean.b / mean[2] - 1), 1e-6);
    shadow_around_free(&around);
}

/* Each is that of the texel it points to, over its density: so often as its part of all the light
 * is, and as much a solid angle all over the texel. */
static void directions_bring_what_their_texels_have(void **state) {
    (void)state;
    static int drawn[TEXELS];
    static double along[TEXELS];
    shadow_around around;
    double all = 0;
    color();
    for (int i = 0; i < TEXELS; i++)
        all += (double)(rgb[i][0] + rgb[i][1] + rgb[i][2]) / 3 * solid_angle(i / WIDTH);
    assert_true(shadow_around_create(&sky, &around));
    for (int i = 0; i < STEPS * STEPS; i++) {
        const float u = ((float)(i / STEPS) + 0.5f) / STEPS,
                    v = ((float)(i % STEPS) + 0.5f) / STEPS;
        lmp_rgb arrives;
        const lmp_vec3 d = shadow_around_draw(&around, u, v, &arrives);
        CHECK_WITHIN(fabsf(d.x * d.x + d.y * d.y + d.z * d.z - 1), 1e-6f);
        const int texel = texel_at(d);
        const float *here = rgb[texel];
        const double scale = 3 * all / (double)(here[0] + here[1] + here[2]);
        CHECK_WITHIN(fabs((double)arrives.r - (double)here[0] * scale), 1e-5 * all);
        CHECK_WITHIN(fabs((double)arrives.g - (double)here[1] * scale), 1e-5 * all);
        CHECK_WITHIN(fabs((double)arrives.b - (double)here[2] * scale), 1e-5 * all);
        drawn[texel]++;
        along[texel] += (double)d.y;
    }
    for (int i = 0; i < TEXELS; i++) {
        const int row = i / WIDTH;
        const double part =
            (double)(rgb[i][0] + rgb[i][1] + rgb[i][2]) / 3 * solid_angle(row) / all;
        CHECK_WITHIN(fabs(drawn[i] - part * STEPS * STEPS), 0.01 * STEPS * STEPS);
        if (drawn[i] > STEPS)
            CHECK_WITHIN(fabs(along[i] / drawn[i] -
                              (cos(pi * row / HEIGHT) + cos(pi * (row + 1) / HEIGHT)) / 2),
                         0.02);
    }
    shadow_around_free(&around);
}

static void darkness_sends_no_rays(void **state) {
    (void)state;
    shadow_around around;
    for (int i = 0; i < TEXELS; i++)
        rgb[i][0] = rgb[i][1] = rgb[i][2] = 0;
    assert_true(shadow_around_create(&sky, &around));
    assert_false(shadow_around_shines(&around));
    shadow_around_free(&around);
    assert_true(shadow_around_create(NULL, &around));
    assert_false(shadow_around_shines(&around));
    shadow_around_free(&around);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_is_that_of_all_directions),
        cmocka_unit_test(directions_bring_what_their_texels_have),
        cmocka_unit_test(darkness_sends_no_rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
