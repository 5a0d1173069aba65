/* SPDX-License-Identifier: MIT */
/* The diffuse lobe under every kind of light, by every method that takes the closed form, against
 * quadrature over what is seen of the light. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/lampion.h>

#include <math.h>

/* A surface at the origin whose normal is z, and a light whose axis is at an angle to it. */
typedef struct configuration {
    lmp_light light;
    double expected, facing; /* irradiance, and that of a surface facing the light */
} configuration;

static lmp_vec3 tilted(double angle, double length) {
    const double around = check_random_between(0, 2 * ORACLE_PI), s = sin(angle) * length;
    return (lmp_vec3) { (float)(s * cos(around)), (float)(s * sin(around)),
                        (float)(cos(angle) * length) };
}

static double cosine_of(lmp_vec3 v) {
    const double x = (double)v.x, y = (double)v.y, z = (double)v.z;
    return z / sqrt(x * x + y * y + z * z);
}

/* Makes a sphere by lampion/light.h: outside a cap of sin a = r/d, inside one that grows on. */
static configuration sphere_of(double distance, double radius, double angle) {
    configuration c = { .light = { .position = tilted(angle, distance),
                                   .radius = (float)radius,
                                   .radiance = { 1, 1, 1 } } };
    const lmp_vec3 p = c.light.position;
    const double r = (double)c.light.radius, x = (double)p.x, y = (double)p.y, z = (double)p.z;
    const double d = sqrt(x * x + y * y + z * z), sine = d < r ? d / r : r / d;
    const double held = sine * sine / (1 + sqrt(1 - sine * sine));
    const double one_minus_cos = d < r ? 2 - held : held;
    c.expected = oracle_irradiance(cosine_of(p), one_minus_cos);
    c.facing = oracle_irradiance(1, one_minus_cos);
    return c;
}

/* Returns the angle, or one near the two at which the horizon begins and ends to cut the light. */
static double angle_near(double half_angle) {
    const double angle = check_random_between(0, ORACLE_PI), near = check_random_between(-0.1, 0.1);
    const double side = check_random() < 0.5 ? 1 : -1;
    return check_random() < 0.5 ? angle : fabs(ORACLE_PI / 2 + side * half_angle * (1 + near));
}

static configuration random_sphere(void) {
    const double r = pow(10, check_random_between(-2, 2));
    const double ratio = pow(10, check_random_between(-4, 4));
    const double half = ratio > 1 ? asin(1 / ratio) : check_random_between(0, 3);
    /* On the surface, cos a changes faster than float32 tells positions apart. */
    const double held = fabs(ratio - 1) < 1e-2 ? 1.01 : ratio;
    return sphere_of(r * held, r, angle_near(half));
}

static configuration random_other(lmp_light_kind kind) {
    const double angle = check_random_between(0, ORACLE_PI),
                 d = pow(10, check_random_between(-3, 3));
    configuration c = { .light = { .kind = kind,
                                   .position = tilted(angle, d),
                                   .direction = tilted(angle, 1),
                                   .radiance = { 1, 1, 1 },
                                   .ground = { 0.25f, 0.25f, 0.25f } } };
    const double cosine = cosine_of(c.light.direction), beside = cosine_of(c.light.position);
    c.light.angle = (float)check_random_between(0, ORACLE_PI);
    if (kind == LMP_LIGHT_SPOT) { /* the axis points away from the light, and all arrives */
        const lmp_vec3 p = c.light.position;
        const float each = 1 / sqrtf(p.x * p.x + p.y * p.y + p.z * p.z);
        c.light.direction = (lmp_vec3) { -p.x * each, -p.y * each, -p.z * each };
        c.light.inner = 0.5f;
        c.light.outer = 1;
    }
    switch (kind) {
    case LMP_LIGHT_DIRECTIONAL:
        c.facing = 1;
        c.expected = fmax(cosine, 0);
        break;
    case LMP_LIGHT_CAP: {
        const double half = sin((double)c.light.angle / 2), one_minus_cos = 2 * half * half;
        c.facing = oracle_irradiance(1, one_minus_cos);
        c.expected = oracle_irradiance(cosine, one_minus_cos);
        break;
    }
    case LMP_LIGHT_HEMISPHERE:
        c.facing = ORACLE_PI;
        c.expected = oracle_irradiance(cosine, 1) + 0.25 * oracle_irradiance(-cosine, 1);
        break;
    case LMP_LIGHT_SPHERE:
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_SPOT:
    case LMP_LIGHT_RECTANGLE: /* areas have tests of their own, area.c */
    case LMP_LIGHT_DISK:
    case LMP_LIGHT_TUBE:
    case LMP_LIGHT_POLYGON:
        c.facing = 1 / (d * d);
        c.expected = fmax(beside, 0) * c.facing;
    }
    return c;
}

/* Makes random configurations: every other one a sphere, the rest of the other kinds in turn. */
static configuration random_configuration(int i) {
    return i % 2 ? random_other((lmp_light_kind)(1 + i / 2 % LMP_LIGHT_HEMISPHERE))
                 : random_sphere();
}

static const lmp_vec3 origin = { 0, 0, 0 }, up = { 0, 0, 1 };

static void irradiance_is_that_of_what_is_seen_of_the_light(void **state) {
    (void)state;
    check_errors errors = { 0 };
    for (int i = 0; i < 20000; i++) {
        const configuration c = random_configuration(i);
        const lmp_rgb e = lmp_light_irradiance(&c.light, 1, origin, up);
        check_errors_add(&errors, ((double)e.g - c.expected) / c.facing);
    }
    printf("of the irradiance of a surface that faces the light: at most %.2g, rms %.2g\n",
           errors.largest, check_errors_rms(&errors));
    CHECK_WITHIN(errors.largest, 3e-6);
}

static void lights_add_up(void **state) {
    (void)state;
    lmp_light lights[12];
    double sum = 0;
    for (int i = 0; i < 12; i++) {
        const configuration c = sphere_of(2, 0.5 + 0.1 * i, 1 + 0.1 * i);
        lights[i] = c.light;
        sum += c.expected;
    }
    const lmp_rgb all = lmp_light_irradiance(lights, 12, origin, up);
    CHECK_WITHIN(fabs((double)all.r / sum - 1), 1e-6);
    const lmp_rgb none = lmp_light_irradiance(NULL, 0, origin, up);
    assert_true(none.r == 0 && none.g == 0 && none.b == 0);
}

/* White paper is shaded under each light by one method, with few bands and a window, which must not
 * matter. */
enum { COUNT = 2000 };

static void check_white_paper(const lmp_shade_settings *settings) {
    const lmp_material paper = { .diffuse = { 1, 1, 1 } };
    check_errors errors = { 0 };
    for (int i = 0; i < COUNT; i++) {
        const configuration c = random_configuration(i);
        const lmp_surface surface = { .position = origin, .normal = up, .view = up };
        const lmp_surfaces one = { .position = lmp_vec3_array_same(&origin),
                                   .normal = lmp_vec3_array_same(&up),
                                   .view = lmp_vec3_array_same(&up),
                                   .material = &paper };
        const lmp_rgb alone = lmp_shade(settings, &paper, &surface, &c.light, 1);
        lmp_rgb many[3]; /* a whole register of surfaces, and a rest */
        lmp_shade_n(settings, &one, 3, &c.light, 1, lmp_rgb_array_of(many));
        check_errors_add(&errors, ((double)alone.g * ORACLE_PI - c.expected) / c.facing);
        check_errors_add(&errors, ((double)many[2].g * ORACLE_PI - c.expected) / c.facing);
    }
    CHECK_WITHIN(errors.largest, 1e-5);
}

static void white_paper_reflects_it_whatever_the_bands_are(void **state) {
    (void)state;
    lmp_preintegrated_lobe *lobe;
    const lmp_preintegrated_lobe_desc desc = { .bands = 5, .window = LMP_WINDOW_HANNING };
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
    check_white_paper(NULL);
    check_white_paper(&(lmp_shade_settings) { .bands = 1 });
    check_white_paper(&(lmp_shade_settings) { .bands = 3, .window = LMP_WINDOW_HANNING });
    check_white_paper(&(lmp_shade_settings) { .bands = 100 });
    check_white_paper(&(lmp_shade_settings) { .method = LMP_SHADE_PREINTEGRATED, .lobe = lobe });
    lmp_preintegrated_lobe_destroy(lobe);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(irradiance_is_that_of_what_is_seen_of_the_light),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(white_paper_reflects_it_whatever_the_bands_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
