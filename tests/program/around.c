/* SPDX-License-Identifier: MIT */
/* Directions drawn from an environment, against the map of it that its format defines: rows of
 * equal angles from the top, columns of equal angles, their middle at the azimuth. */
#include "app/render/shadow/toward.h"

#include "tests/oracle/check.h"

#include <math.h>

enum { WIDTH = 7, HEIGHT = 5, TEXELS = WIDTH * HEIGHT, STEPS = 256 };

static float rgb[TEXELS][3];
static environment sky = { .light = { WIDTH, HEIGHT, rgb[0] }, .azimuth = 0.7f };
static const double pi = 3.14159265358979323846;

/* Gives every texel its own color; some are black, and one is a sun. */
static void color(void) {
    for (int i = 0; i < TEXELS; i++)
        for (int c = 0; c < 3; c++)
            rgb[i][c] = i % 5 == 3 ? 0 : (float)check_random_between(0.1, 1 + c);
    rgb[11][0] = 50;
}

/* Returns the solid angle of a texel in a row: a part of the belt between two cosines. */
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

static double all_light(void) {
    double all = 0;
    for (int i = 0; i < TEXELS; i++)
        all += (double)(rgb[i][0] + rgb[i][1] + rgb[i][2]) / 3 * solid_angle(i / WIDTH);
    return all;
}

/* Returns the middle of a step. */
static float step(int number) {
    return ((float)number + 0.5f) / STEPS;
}

/* Returns the radiance over the density. */
static lmp_rgb arrives_by(const shadow_arrival *a) {
    return (lmp_rgb) { a->radiance.r / a->density, a->radiance.g / a->density,
                       a->radiance.b / a->density };
}

/* Each direction brings the radiance of the texel it points to, over its density: texels are drawn
 * as often as their fraction of all light, uniformly over their solid angle. */
static void directions_bring_what_their_texels_have(void **state) {
    (void)state;
    static int drawn[TEXELS];
    static double along[TEXELS];
    shadow_around around;
    color();
    const double all = all_light();
    assert_true(shadow_around_create(&sky, &around));
    for (int i = 0; i < STEPS * STEPS; i++) {
        shadow_arrival arrival;
        const lmp_vec3 d = shadow_around_draw(&around, step(i / STEPS), step(i % STEPS), &arrival);
        const lmp_rgb arrives = arrives_by(&arrival);
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

/* The radiance is that of the direction's texel, and its density that of shadow_around_draw. */
static void a_direction_has_the_radiance_of_its_texel(void **state) {
    (void)state;
    shadow_around around;
    color();
    const double all = all_light();
    assert_true(shadow_around_create(&sky, &around));
    for (int i = 0; i < 1000; i++) {
        const lmp_vec3 d = check_random_direction();
        const float *here = rgb[texel_at(d)];
        const shadow_arrival a = shadow_around_look(&around, d);
        assert_true(a.radiance.r == here[0] && a.radiance.g == here[1] && a.radiance.b == here[2]);
        CHECK_WITHIN(fabs((double)a.density * all - (double)(here[0] + here[1] + here[2]) / 3),
                     1e-5);
    }
    shadow_around_free(&around);
}

/* Returns the irradiance of a normal by summing over the texels in small steps. */
static double irradiance_of(lmp_vec3 normal) {
    enum { FINE = 40 };
    double sum = 0;
    for (int y = 0; y < HEIGHT * FINE; y++)
        for (int x = 0; x < WIDTH * FINE; x++) {
            const double down = pi * (y + 0.5) / (HEIGHT * FINE);
            const double turns = (x + 0.5) / (WIDTH * FINE) - 0.5;
            const double azimuth = 2 * pi * turns + (double)sky.azimuth;
            const double along = sin(down) * cos(azimuth) * (double)normal.x +
                                 cos(down) * (double)normal.y +
                                 sin(down) * sin(azimuth) * (double)normal.z;
            const double solid = sin(down) * pi / (HEIGHT * FINE) * 2 * pi / (WIDTH * FINE);
            sum += along > 0 ? along * solid * (double)rgb[y / FINE * WIDTH + x / FINE][0] : 0;
        }
    return sum;
}

/* Whichever part of the mixture weighs most, the mean of what arrives times the cosine is the
 * irradiance, because the densities are those by which directions are drawn. */
static void directions_toward_a_surface_bring_its_irradiance(void **state) {
    (void)state;
    static shadow_points points; /* the same point in every lane */
    const float parts[][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0.5f, 0.3f, 0.4f }, { 0 } };
    shadow_around around;
    color();
    assert_true(shadow_around_create(&sky, &around));
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
        const lmp_vec3 n = { 0.6f, -0.48f, 0.64f };
        double sum = 0;
        points.coated = parts[k][2] > 0;
        points.albedo[0] = parts[k][0], points.shine[0] = parts[k][1], points.coat[0] = parts[k][2];
        points.alpha2[0] = 0.3f, points.coat_alpha2[0] = 0.1f;
        shadow_set_lane(&points.normal, 0, n);
        shadow_set_lane(&points.mirror, 0, (lmp_vec3) { 0, -0.6f, 0.8f });
        shadow_set_lane(&points.coat_mirror, 0, (lmp_vec3) { 1, 0, 0 });
        for (int i = 0; i < STEPS * STEPS; i++) {
            shadow_arrival arrival;
            const lmp_vec3 d =
                shadow_draw_toward(&around, &points, 0, step(i / STEPS), step(i % STEPS), &arrival);
            const lmp_rgb arrives = arrives_by(&arrival);
            CHECK_WITHIN(fabsf(d.x * d.x + d.y * d.y + d.z * d.z - 1), 1e-5f);
            sum += (double)arrives.r * fmax((double)(d.x * n.x + d.y * n.y + d.z * n.z), 0);
        }
        const double expected = irradiance_of(n);
        CHECK_WITHIN(fabs(sum / (STEPS * STEPS) - expected), 0.02 * expected);
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
        cmocka_unit_test(a_direction_has_the_radiance_of_its_texel),
        cmocka_unit_test(directions_toward_a_surface_bring_its_irradiance),
        cmocka_unit_test(darkness_sends_no_rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
