/* SPDX-License-Identifier: MIT */
/* Tables of spheres, from outside and inside, of their gradients, and of caps. */
#include "ruler/vectors/harmonics.h"
#include "ruler/vectors/tables.h"

#include <math.h>
#include <stdio.h>

#define BITS VECTORS_PRECISION

typedef struct sphere {
    double center[3], radius, point[3];
} sphere;

/* Makes a sphere with its position in units of 1/1024, so that differences are exact; the radius is
 * a float of about `ratio` times the distance. */
static sphere sphere_of(int row, double ratio) {
    sphere s;
    double squared = 0;
    for (int k = 0; k < 3; k++) {
        s.center[k] = floor(16384 * vectors_fraction(row, k)) / 1024 - 8;
        s.point[k] = floor(8192 * vectors_fraction(row, 3 + k)) / 1024 - 4;
        squared += (s.center[k] - s.point[k]) * (s.center[k] - s.point[k]);
    }
    s.radius = (double)(float)(ratio * sqrt(squared));
    return s;
}

/* Makes a sphere seen from outside: the first rows have ratio 0.999, the others from 0.95 down to a
 * millionth. */
static sphere outside(int row) {
    return sphere_of(200 + row, row <= 3 ? 0.999 : pow(10, -6 * (row - 4) / 57.0) * 0.95);
}

static void print_sphere(const sphere *s) {
    vectors_print_inputs(s->center, 3);
    vectors_print_inputs(&s->radius, 1);
    vectors_print_inputs(s->point, 3);
}

static void from_point(const sphere *s, double center[3]) {
    for (int k = 0; k < 3; k++)
        center[k] = s->center[k] - s->point[k];
}

static void header_of(const char *prefix, int count) {
    printf("light_x,light_y,light_z,radius,recv_x,recv_y,recv_z,");
    vectors_print_names(prefix, count);
}

static void print_coefficients(const sphere *s, int bands) {
    double center[3];
    acb_t value, none;
    mag_t bound;
    acb_init(value);
    acb_init(none);
    mag_init(bound);
    print_sphere(s);
    from_point(s, center);
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++) {
            harmonics_sphere(value, l, m, center, s->radius, 0, none);
            vectors_print_value(acb_realref(value), bound);
        }
    vectors_print_bound(bound);
    acb_clear(value);
    acb_clear(none);
    mag_clear(bound);
}

void vectors_sphere_header(void) {
    header_of("c", 100);
    printf("bound\n");
}

void vectors_sphere_row(int row) {
    const sphere s = outside(row);
    print_coefficients(&s, 10);
}

void vectors_inside_header(void) {
    header_of("c", 36);
    printf("bound\n");
}

void vectors_inside_row(int row) {
    static const double ratios[8] = { 1.01, 1.1, 1.25, 1.5, 2, 4, 64, 0 };
    sphere s = sphere_of(300 + row, ratios[row - 1]);
    if (s.radius == 0) {
        s.radius = 3;
        for (int k = 0; k < 3; k++)
            s.point[k] = s.center[k];
    }
    print_coefficients(&s, 6);
}

/* --- gradients -------------------------------------------------------------------------------- */

void vectors_gradient_header(void) {
    header_of("dx", 36);
    vectors_print_names("dy", 36);
    vectors_print_names("dz", 36);
    printf("bound\n");
}

void vectors_gradient_row(int row) {
    const sphere s = outside(3 * row);
    double center[3];
    arb_t value;
    mag_t bound;
    arb_init(value);
    mag_init(bound);
    print_sphere(&s);
    from_point(&s, center);
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 6; l++)
            for (int m = -l; m <= l; m++) {
                harmonics_sphere_derivative(value, l, m, center, s.radius, k);
                vectors_print_value(value, bound);
            }
    vectors_print_bound(bound);
    arb_clear(value);
    mag_clear(bound);
}

/* The tables keep every eleventh coefficient of three bands, and its gradient. */
enum { STEP = 11, KEPT = 2 * (127 / STEP) + 1 };

void vectors_sphere_128_header(void) {
    printf("light_x,light_y,light_z,radius,recv_x,recv_y,recv_z,l,");
    vectors_print_names("c", KEPT);
    vectors_print_names("dx", KEPT);
    vectors_print_names("dy", KEPT);
    vectors_print_names("dz", KEPT);
    printf("bound\n");
}

/* Prints the coefficients m = 11 (k - KEPT/2) of band l, 0 where there is none, or their
 * derivatives along an axis; axis -1 means the values. */
static void print_spread(const sphere *s, int l, int axis, mag_t bound) {
    double center[3];
    acb_t value, none;
    acb_init(value);
    acb_init(none);
    from_point(s, center);
    for (int m = -STEP * (KEPT / 2); m <= STEP * (KEPT / 2); m += STEP) {
        acb_zero(value);
        if (m >= -l && m <= l && axis < 0)
            harmonics_sphere(value, l, m, center, s->radius, 0, none);
        else if (m >= -l && m <= l)
            harmonics_sphere_derivative(acb_realref(value), l, m, center, s->radius, axis);
        vectors_print_value(acb_realref(value), bound);
    }
    acb_clear(value);
    acb_clear(none);
}

void vectors_sphere_128_row(int row) {
    static const int degrees[3] = { 31, 64, 127 }, rows[6] = { 6, 12, 18, 24, 36, 54 };
    const sphere s = outside(rows[(row - 1) / 3]);
    const int l = degrees[(row - 1) % 3];
    mag_t bound;
    mag_init(bound);
    print_sphere(&s);
    printf("%d,", l);
    for (int axis = -1; axis < 3; axis++)
        print_spread(&s, l, axis, bound);
    vectors_print_bound(bound);
    mag_clear(bound);
}

/* --- caps ------------------------------------------------------------------------------------- */

void vectors_zonal_header(void) {
    printf("r_over_d,");
    vectors_print_names("Z", 128);
    printf("bound\n");
}

/* A row has sqrt((2l + 1)/(4 pi)) times the cap's integral; the ratio is a float. */
void vectors_zonal_row(int row) {
    static const double first[4] = { 0.999, 0.99, 0.9, 0.7 };
    const double ratio = (double)(float)(row <= 4 ? first[row - 1] : pow(10, -(row - 4) / 3.0));
    acb_t cosine, value;
    arb_t scale;
    mag_t bound;
    acb_init(cosine);
    acb_init(value);
    arb_init(scale);
    mag_init(bound);
    vectors_print_inputs(&ratio, 1);
    acb_set_d(cosine, ratio);
    acb_mul(cosine, cosine, cosine, BITS);
    acb_sub_ui(cosine, cosine, 1, BITS);
    acb_neg(cosine, cosine);
    acb_sqrt(cosine, cosine, BITS);
    for (int l = 0; l < 128; l++) {
        harmonics_cap(value, l, cosine);
        arb_const_pi(scale, BITS);
        arb_mul_2exp_si(scale, scale, 2);
        arb_ui_div(scale, (ulong)(2 * l + 1), scale, BITS);
        arb_sqrt(scale, scale, BITS);
        arb_mul(acb_realref(value), acb_realref(value), scale, BITS);
        vectors_print_value(acb_realref(value), bound);
    }
    vectors_print_bound(bound);
    acb_clear(cosine);
    acb_clear(value);
    arb_clear(scale);
    mag_clear(bound);
}
