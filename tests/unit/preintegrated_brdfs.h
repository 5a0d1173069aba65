/* SPDX-License-Identifier: MIT */
/* preintegrated_brdfs.h - preintegrated materials, and where more than one test reads them. */
#ifndef LAMPION_PREINTEGRATED_BRDFS_H
#define LAMPION_PREINTEGRATED_BRDFS_H

#include "tests/oracle/check.h"
#include "tests/unit/brdfs.h"

#include <lampion/lampion.h>

#include <math.h>

static const double pi = 3.14159265358979324;

static inline lmp_brdf_table *table_of(lmp_brdf *brdf, const lmp_brdf_table_desc *desc) {
    lmp_brdf_table *table;
    assert_int_equal(lmp_brdf_table_create(NULL, desc, brdf, &table), LMP_OK);
    lmp_brdf_destroy(brdf);
    return table;
}

static inline lmp_brdf_table *sgd_table(const char *name, int bands, lmp_window window) {
    const lmp_brdf_table_desc desc = { .bands = bands, .window = window, .rings_max = 128 };
    return table_of(sgd_brdf(name), &desc);
}

static inline lmp_preintegrated_brdf *created(const lmp_brdf_table *table, float error) {
    lmp_preintegrated_brdf *preintegrated;
    const lmp_preintegrated_brdf_desc desc = { .error = error };
    assert_int_equal(lmp_preintegrated_brdf_create(NULL, &desc, table, &preintegrated), LMP_OK);
    return preintegrated;
}

/* A view, and a sphere of radiance 1 at distance 1: a cap of a given size. */
typedef struct probe {
    double theta;
    float radius;
} probe;

/* Returns a direction at g, p around the mirror direction, in the frame whose z is the normal. */
static inline lmp_vec3 around_mirror(const probe *p, double g, double azimuth) {
    const double x = sin(g) * cos(azimuth), y = sin(g) * sin(azimuth), z = cos(g);
    const double c = cos(p->theta), s = sin(p->theta);
    return (lmp_vec3) { (float)(c * x - s * z), (float)y, (float)(s * x + c * z) };
}

static inline lmp_vec3 random_direction(const probe *p, int i, double detail) {
    double g = fabs(asin(fmin((double)p->radius, 1)) + detail * check_random_between(-4, 4));
    if (i % 3 == 1)
        g = acos(check_random_between(-1, 1));
    if (i % 3 == 2)
        g = check_random_between(0, 0.3);
    return around_mirror(p, i == 0 ? 0 : fmin(g, pi), check_random_between(0, 2 * pi));
}

static inline probe random_probe(double least, double most) {
    return (probe) { check_random() < 0.8 ? pi / 2 * check_random()
                                          : pi / 2 * (1 - 0.1 * check_random()),
                     (float)pow(10, check_random_between(least, most)) };
}

#endif
