/* SPDX-License-Identifier: MIT */
/* fields.h - fields for the tests of fields, and lights drawn at random. */
#ifndef LAMPION_FIELDS_H
#define LAMPION_FIELDS_H

#include "tests/oracle/check.h"

#include <lampion/lampion.h>

#include <math.h>
#include <stdlib.h>

/* Returns a random point of the box from `low` to `high` in every axis. */
static inline lmp_vec3 field_point(double low, double high) {
    const float x = (float)check_random_between(low, high),
                y = (float)check_random_between(low, high);
    return (lmp_vec3) { x, y, (float)check_random_between(low, high) };
}

static inline lmp_light field_sphere_light(double low, double high) {
    const float red = (float)check_random_between(0.5, 2),
                green = (float)check_random_between(0, 2);
    return (lmp_light) { .position = field_point(low, high),
                         .radius = (float)check_random_between(0.02, 0.3),
                         .radiance = { red, green, 1 } };
}

static inline void field_sphere_lights(double low, double high, size_t count, lmp_light *lights) {
    for (size_t i = 0; i < count; i++)
        lights[i] = field_sphere_light(low, high);
}

static inline lmp_field *field_of(const lmp_field_desc *desc, const lmp_light *lights,
                                  size_t count) {
    lmp_field *field;
    assert_int_equal(lmp_field_create(NULL, desc, &field), LMP_OK);
    assert_int_equal(lmp_field_update(NULL, field, lights, count), LMP_OK);
    return field;
}

/* Returns the root of the sum of squares of a - b, and of a. */
static inline double field_distance(const float *a, const float *b, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
    return sqrt(sum);
}
static inline double field_size(const float *a, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += (double)a[i] * (double)a[i];
    return sqrt(sum);
}

/* Returns the error of a field's coefficients at a point, relative to the sum of its lights' sizes.
 */
static inline double field_error(const lmp_field *field, lmp_vec3 point) {
    const lmp_field_info info = lmp_field_describe(field);
    const size_t n = 3 * LMP_SH_COUNT(info.desc.bands);
    float exact[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX],
        one[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX];
    double sizes = 0;
    for (size_t i = 0; i < info.light_count; i++) {
        lmp_light_project(info.desc.bands, lmp_field_lights(field) + i, 1, point, one);
        sizes += field_size(one, n);
    }
    lmp_light_project(info.desc.bands, lmp_field_lights(field), info.light_count, point, exact);
    lmp_field_eval_n(field, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(one, 0));
    return field_distance(one, exact, n) / sizes;
}

#endif
