/* SPDX-License-Identifier: MIT */
#include "ruler/vectors/tables.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

#define VECTORS_NOTHING 1e-40 /* the size of values that are 0 except for rounding */

const vectors_table vectors_tables[] = {
    { "basis", 40, vectors_basis_header, vectors_basis_row },
    { "basis_128", 8 * 3, vectors_basis_128_header, vectors_basis_128_row },
    { "sphere", 60, vectors_sphere_header, vectors_sphere_row },
    { "sphere_inside", 8, vectors_inside_header, vectors_inside_row },
    { "sphere_gradient", 20, vectors_gradient_header, vectors_gradient_row },
    { "sphere_128", 6 * 3, vectors_sphere_128_header, vectors_sphere_128_row },
    { "zonal", 20, vectors_zonal_header, vectors_zonal_row },
    { "rotation", 10, vectors_rotation_header, vectors_rotation_row },
    { "rotation_128", 8 * 3, vectors_rotation_128_header, vectors_rotation_128_row },
    { "product", 10, vectors_product_header, vectors_product_row },
    { "product_12", 4, vectors_product_12_header, vectors_product_12_row },
    { "lobe", 21, vectors_lobe_header, vectors_lobe_row },
    { "brdf_table", 12, vectors_table_header, vectors_table_row },
    { NULL, 0, NULL, NULL },
};

void vectors_print_names(const char *prefix, int count) {
    for (int k = 0; k < count; k++)
        printf("%s_%d,", prefix, k);
}

void vectors_print_inputs(const double *inputs, int count) {
    for (int k = 0; k < count; k++)
        printf("%.17g,", inputs[k]);
}

void vectors_print_value(const arb_t value, mag_t bound) {
    const double rounded = arf_get_d(arb_midref(value), ARF_RND_NEAR);
    const double nearest = fabs(rounded) < VECTORS_NOTHING ? 0 : rounded;
    arb_t rest;
    mag_t off;
    arb_init(rest);
    mag_init(off);
    arb_set_d(rest, nearest);
    arb_sub(rest, value, rest, 2048);
    arb_get_mag(off, rest);
    mag_max(bound, bound, off);
    printf("%.17g,", nearest);
    arb_clear(rest);
    mag_clear(off);
}

void vectors_print_bound(mag_t bound) {
    printf("%.2g\n", mag_get_d(bound) * 1.06);
    fflush(stdout);
}

/* Mixes both numbers by SplitMix64. */
double vectors_fraction(int row, int k) {
    uint64_t z =
        ((uint64_t)(unsigned)row << 32 | (unsigned)k) * 0x9e3779b97f4a7c15u + 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 44) / 1048576;
}
