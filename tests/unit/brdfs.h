/* SPDX-License-Identifier: MIT */
/* brdfs.h - the BRDFs that several tests measure, and directions for them. */
#ifndef LAMPION_BRDFS_H
#define LAMPION_BRDFS_H

#include "tests/oracle/check.h"

#include <lampion/brdf.h>

#include <math.h>

static inline lmp_brdf *lambert(float r, float g, float b) {
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_create_lambert(NULL, (lmp_rgb) { r, g, b }, &brdf), LMP_OK);
    return brdf;
}

static inline lmp_brdf *phong(float exponent) {
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_create_phong(NULL, (lmp_rgb) { 1, 0.5f, 0.25f }, exponent, &brdf),
                     LMP_OK);
    return brdf;
}

static inline lmp_brdf *ggx(float alpha_x, float alpha_y) {
    const lmp_ggx desc = { alpha_x, alpha_y, { 0.9f, 0.6f, 0.3f }, { 0.1f, 0.1f, 0.2f } };
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &desc, &brdf), LMP_OK);
    return brdf;
}

static inline lmp_brdf *sgd_brdf(const char *name) {
    lmp_sgd parameters;
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_find_sgd(name, &parameters), LMP_OK);
    assert_int_equal(lmp_brdf_create_sgd(NULL, &parameters, &brdf), LMP_OK);
    return brdf;
}

static inline lmp_vec3 random_upper(void) {
    lmp_vec3 w = check_random_direction();
    w.z = fabsf(w.z);
    return w;
}

#endif
