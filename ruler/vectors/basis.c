/* SPDX-License-Identifier: MIT */
/* Tables of the basis, its rotation and its products. */
#include "ruler/vectors/harmonics.h"
#include "ruler/vectors/tables.h"

#include <math.h>
#include <stdio.h>

#define BITS VECTORS_PRECISION

/* --- values of the basis ---------------------------------------------------------------------- */

/* Chooses directions: axes, then near the poles, then anywhere; of any length. */
static void direction(int row, double w[3]) {
    static const double axes[6][3] = { { 1, 0, 0 },  { -1, 0, 0 }, { 0, 1, 0 },
                                       { 0, -1, 0 }, { 0, 0, 1 },  { 0, 0, -1 } };
    static const double near[4] = { 0x1p-10, 0x1p-20, 0x1p-30, 0x1p-40 };
    for (int k = 0; k < 3; k++)
        w[k] = row <= 6 ? axes[row - 1][k] : 2 * vectors_fraction(row, k) - 1;
    if (row > 6 && row <= 14) {
        const double size = near[(row - 7) / 2];
        w[0] *= size;
        w[1] *= size;
        w[2] = row % 2 ? 1 : -1;
    }
}

static void print_band(const double w[3], int l, mag_t bound) {
    arb_ptr v = _arb_vec_init(3);
    arb_t y;
    arb_init(y);
    for (int k = 0; k < 3; k++)
        arb_set_d(v + k, w[k]);
    for (int m = -l; m <= l; m++) {
        harmonics_at_real(y, l, m, v);
        vectors_print_value(y, bound);
    }
    arb_clear(y);
    _arb_vec_clear(v, 3);
}

void vectors_basis_header(void) {
    printf("x,y,z,");
    vectors_print_names("Y", 169);
    printf("bound\n");
}

void vectors_basis_row(int row) {
    double w[3];
    mag_t bound;
    mag_init(bound);
    direction(row, w);
    vectors_print_inputs(w, 3);
    for (int l = 0; l < 13; l++)
        print_band(w, l, bound);
    vectors_print_bound(bound);
    mag_clear(bound);
}

/* A row holds one band, and is as wide as the widest: unused columns are 0. */
void vectors_basis_128_header(void) {
    printf("x,y,z,l,");
    vectors_print_names("Y", 255);
    printf("bound\n");
}

void vectors_basis_128_row(int row) {
    static const int degrees[3] = { 31, 64, 127 }, rows[8] = { 1, 5, 7, 14, 15, 16, 17, 18 };
    const int l = degrees[(row - 1) % 3];
    double w[3];
    mag_t bound;
    mag_init(bound);
    direction(rows[(row - 1) / 3], w);
    vectors_print_inputs(w, 3);
    printf("%d,", l);
    print_band(w, l, bound);
    for (int k = 2 * l + 1; k < 255; k++)
        printf("0,");
    vectors_print_bound(bound);
    mag_clear(bound);
}

/* --- rotations -------------------------------------------------------------------------------- */

enum { ROTATED = 8 };

typedef struct rotated {
    arb_ptr matrix; /* of the rotation, row by row */
    const double *in;
    int l, m;
} rotated;

/* Computes the matrix of a quaternion x, y, z, w of integers, of any length. */
static void matrix_of(arb_ptr matrix, const double q[4]) {
    const double x = q[0], y = q[1], z = q[2], w = q[3], all = x * x + y * y + z * z + w * w;
    const double r[9] = { w * w + x * x - y * y - z * z, 2 * (x * y - z * w),
                          2 * (x * z + y * w),           2 * (x * y + z * w),
                          w * w - x * x + y * y - z * z, 2 * (y * z - x * w),
                          2 * (x * z - y * w),           2 * (y * z + x * w),
                          w * w - x * x - y * y + z * z };
    for (int k = 0; k < 9; k++) {
        arb_set_d(matrix + k, r[k]);
        arb_div_si(matrix + k, matrix + k, (slong)all, BITS);
    }
}

/* Evaluates band l of f(R' w), times Y_lm(w); other bands do not mix with it. */
static void rotated_at(arb_t value, arb_srcptr w, void *user) {
    const rotated *const r = user;
    arb_ptr v = _arb_vec_init(3);
    arb_t y, in;
    arb_init(y);
    arb_init(in);
    for (int k = 0; k < 3; k++)
        arb_dot(v + k, NULL, 0, r->matrix + k, 3, w, 1, 3, BITS);
    arb_zero(value);
    for (int m = -r->l; m <= r->l; m++) {
        harmonics_at_real(y, r->l, m, v);
        arb_set_d(in, r->in[r->l * r->l + r->l + m]);
        arb_addmul(value, y, in, BITS);
    }
    harmonics_at_real(y, r->l, r->m, w);
    arb_mul(value, value, y, BITS);
    arb_clear(y);
    arb_clear(in);
    _arb_vec_clear(v, 3);
}

void vectors_rotation_header(void) {
    printf("qx,qy,qz,qw,");
    vectors_print_names("in", ROTATED * ROTATED);
    vectors_print_names("out", ROTATED * ROTATED);
    printf("bound\n");
}

void vectors_rotation_row(int row) {
    static const double simple[4][4] = {
        { 0, 0, 1, 1 }, { 1, 0, 0, 1 }, { 0, 1, 0, 0 }, { 1, 1, 1, 1 }
    };
    double q[4], in[ROTATED * ROTATED];
    rotated r = { .matrix = _arb_vec_init(9), .in = in };
    arb_t value;
    mag_t bound;
    arb_init(value);
    mag_init(bound);
    for (int k = 0; k < 4; k++)
        q[k] = row <= 4 ? simple[row - 1][k] : floor(16 * vectors_fraction(row, k)) - 7;
    for (int k = 0; k < ROTATED * ROTATED; k++)
        in[k] = 2 * vectors_fraction(row, 4 + k) - 1;
    matrix_of(r.matrix, q);
    vectors_print_inputs(q, 4);
    vectors_print_inputs(in, ROTATED * ROTATED);
    for (r.l = 0; r.l < ROTATED; r.l++)
        for (r.m = -r.l; r.m <= r.l; r.m++) {
            harmonics_integrate(value, r.l + 1, rotated_at, &r);
            vectors_print_value(value, bound);
        }
    vectors_print_bound(bound);
    arb_clear(value);
    mag_clear(bound);
    _arb_vec_clear(r.matrix, 9);
}

/* Coefficients Y_lm(p) are a band of a peak at p; rotated, they are a peak at R p. */
enum { ROTATED_WIDTH = 2 * 127 + 1 };

void vectors_rotation_128_header(void) {
    printf("qx,qy,qz,qw,x,y,z,l,");
    vectors_print_names("out", ROTATED_WIDTH);
    printf("bound\n");
}

void vectors_rotation_128_row(int row) {
    static const int bands[] = { 31, 64, 127 };
    const int l = bands[(row - 1) % 3], peak = 300 + (row - 1) / 3;
    double in[8];
    arb_ptr matrix = _arb_vec_init(9), p = _arb_vec_init(3), v = _arb_vec_init(3);
    arb_t value;
    mag_t bound;
    arb_init(value);
    mag_init(bound);
    for (int k = 0; k < 7; k++)
        in[k] = floor(16 * vectors_fraction(peak, k)) - 7;
    in[7] = l;
    matrix_of(matrix, in);
    for (int k = 0; k < 3; k++)
        arb_set_d(p + k, in[4 + k]);
    for (int k = 0; k < 3; k++)
        arb_dot(v + k, NULL, 0, matrix + 3 * k, 1, p, 1, 3, BITS);
    vectors_print_inputs(in, 8);
    for (int k = 0; k < ROTATED_WIDTH; k++) {
        arb_zero(value);
        if (k <= 2 * l)
            harmonics_at_real(value, l, k - l, v);
        vectors_print_value(value, bound);
    }
    vectors_print_bound(bound);
    arb_clear(value);
    mag_clear(bound);
    _arb_vec_clear(matrix, 9);
    _arb_vec_clear(p, 3);
    _arb_vec_clear(v, 3);
}

/* --- products --------------------------------------------------------------------------------- */

/* The basis at all directions of the quadrature, in the order of its evaluations. */
typedef struct product {
    int bands;
    arb_ptr basis; /* directions times bands² */
    const double *a, *b;
    int next, index;
} product;

static void product_fill(arb_t value, arb_srcptr w, void *user) {
    product *const p = user;
    arb_ptr row = p->basis + (slong)p->next++ * p->bands * p->bands;
    for (int l = 0; l < p->bands; l++)
        for (int m = -l; m <= l; m++)
            harmonics_at_real(row++, l, m, w);
    arb_zero(value);
}

static void product_at(arb_t value, arb_srcptr w, void *user) {
    product *const p = user;
    arb_ptr row = p->basis + (slong)p->next++ * p->bands * p->bands;
    arb_t b, in;
    (void)w;
    arb_init(b);
    arb_init(in);
    arb_zero(value);
    for (int k = 0; k < p->bands * p->bands; k++) {
        arb_set_d(in, p->a[k]);
        arb_addmul(value, in, row + k, BITS);
        arb_set_d(in, p->b[k]);
        arb_addmul(b, in, row + k, BITS);
    }
    arb_mul(value, value, b, BITS);
    arb_mul(value, value, row + p->index, BITS);
    arb_clear(b);
    arb_clear(in);
}

static void print_product_header(int bands) {
    vectors_print_names("a", bands * bands);
    vectors_print_names("b", bands * bands);
    vectors_print_names("c", bands * bands);
    printf("bound\n");
}

/* Prints the product of two series. Each coefficient integrates three series of n bands, a
 * polynomial of degree 3n - 3, for which the nodes are exact. */
static void print_product(int bands, int seed) {
    enum { MOST = 12 };
    const int count = bands * bands, nodes = (3 * bands - 1) / 2;
    const slong size = 2L * nodes * nodes * count;
    double in[2 * MOST * MOST];
    product p = { .bands = bands, .basis = _arb_vec_init(size), .a = in, .b = in + count };
    arb_t value;
    mag_t bound;
    arb_init(value);
    mag_init(bound);
    for (int k = 0; k < 2 * count; k++)
        in[k] = 2 * vectors_fraction(seed, k) - 1;
    vectors_print_inputs(in, 2 * count);
    harmonics_integrate(value, nodes, product_fill, &p);
    for (p.index = 0; p.index < count; p.index++) {
        p.next = 0;
        harmonics_integrate(value, nodes, product_at, &p);
        vectors_print_value(value, bound);
    }
    vectors_print_bound(bound);
    arb_clear(value);
    mag_clear(bound);
    _arb_vec_clear(p.basis, size);
}

void vectors_product_header(void) {
    print_product_header(6);
}

void vectors_product_row(int row) {
    print_product(6, 100 + row);
}

void vectors_product_12_header(void) {
    print_product_header(12);
}

void vectors_product_12_row(int row) {
    print_product(12, 200 + row);
}
