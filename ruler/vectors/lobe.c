/* SPDX-License-Identifier: MIT */
/* Tables of the factors of each band for lobes of a cosine's power and of a spherical Gaussian, and
 * of the coefficients of diffuse and Phong reflection at a view. */
#include "ruler/vectors/harmonics.h"
#include "ruler/vectors/tables.h"

#include <arb_hypgeom.h>
#include <math.h>
#include <stdio.h>

#define BITS VECTORS_PRECISION

/* --- zonal responses -------------------------------------------------------------------------- */

enum { DEGREES = 32 };

/* Computes the integral of t^e P_l(t) over 0 … 1 by the powers of P_l: P_l = 2^-l sum (-1)^k C(l,k)
 * C(2l-2k,l) t^(l-2k). */
static void of_power(arb_t value, const arb_t e, int l) {
    arb_t term, below;
    fmpz_t first, second;
    arb_init(term);
    arb_init(below);
    fmpz_init(first);
    fmpz_init(second);
    arb_zero(value);
    for (int k = 0; 2 * k <= l; k++) {
        fmpz_bin_uiui(first, (ulong)l, (ulong)k);
        fmpz_bin_uiui(second, (ulong)(2 * l - 2 * k), (ulong)l);
        fmpz_mul(first, first, second);
        arb_add_si(below, e, l - 2 * k + 1, BITS);
        arb_set_fmpz(term, first);
        arb_div(term, term, below, BITS);
        (k % 2 ? arb_sub : arb_add)(value, value, term, BITS);
    }
    arb_mul_2exp_si(value, value, -l);
    arb_clear(term);
    arb_clear(below);
    fmpz_clear(first);
    fmpz_clear(second);
}

/* Computes I_(l+1/2)(k) / I_(1/2)(k). */
static void of_gaussian(arb_t value, const arb_t sharpness, int l) {
    arb_t order, zeroth;
    arb_init(order);
    arb_init(zeroth);
    arb_set_d(order, 0.5);
    arb_hypgeom_bessel_i_scaled(zeroth, order, sharpness, BITS);
    arb_set_d(order, l + 0.5);
    arb_hypgeom_bessel_i_scaled(value, order, sharpness, BITS);
    arb_div(value, value, zeroth, BITS);
    arb_clear(order);
    arb_clear(zeroth);
}

void vectors_lobe_header(void) {
    printf("kind,exponent,");
    vectors_print_names("lambda", DEGREES);
    printf("bound\n");
}

void vectors_lobe_row(int row) {
    static const char *const kinds[] = { "cosine", "phong", "vmf" };
    static const double exponents[] = { 1,    0.5,        1,        2,  5,   10,  14.8359375,
                                        20,   24.3046875, 46.59375, 64, 100, 200, 500,
                                        1000, 2000,       0.5,      2,  10,  50,  300 };
    const int kind = row == 1 ? 0 : row <= 16 ? 1 : 2;
    arb_t e, value, scale;
    mag_t bound;
    arb_init(e);
    arb_init(value);
    arb_init(scale);
    mag_init(bound);
    printf("%s,", kinds[kind]);
    vectors_print_inputs(&exponents[row - 1], 1);
    arb_set_d(e, exponents[row - 1]);
    for (int l = 0; l < DEGREES; l++) {
        if (kind == 2)
            of_gaussian(value, e, l);
        else
            of_power(value, e, l);
        if (kind == 0) {
            arb_const_pi(scale, BITS);
            arb_mul_2exp_si(scale, scale, 1);
            arb_mul(value, value, scale, BITS);
        } else if (kind == 1) {
            arb_add_ui(scale, e, 1, BITS);
            arb_mul(value, value, scale, BITS);
        }
        vectors_print_value(value, bound);
    }
    vectors_print_bound(bound);
    arb_clear(e);
    arb_clear(value);
    arb_clear(scale);
    mag_clear(bound);
}

/* --- tables of BRDFs -------------------------------------------------------------------------- */

enum { BANDS = 10, COUNT = BANDS * (BANDS + 1) / 2, LEAST = 64, MOST = 112 };

/* f_r cos over the directions (cos t sin p, sin t, cos t cos p), t from -pi/2 to pi/2: below the
 * horizon and behind the lobe begin at bounds of p alone. Trigonometric polynomials of degree N are
 * at most their largest value times e^(N |imaginary part|) (Bernstein), which on the ellipse of 4
 * is at most e^(N 2.95); by theorem 19.3 of Trefethen n nodes err by less than 40 times that times
 * 4^(2 - 2n): below 1e-18 for the degrees here. */
typedef struct reflection {
    int exponent; /* 0 for diffuse reflection */
    double view;
} reflection;

static void node_of(arb_t x, arb_t weight, int n, int i, const arb_t low, const arb_t high) {
    arb_t half;
    arb_init(half);
    arb_hypgeom_legendre_p_ui_root(x, weight, (ulong)n, (ulong)i, BITS);
    arb_sub(half, high, low, BITS);
    arb_mul_2exp_si(half, half, -1);
    arb_mul(x, x, half, BITS);
    arb_add(x, x, low, BITS);
    arb_add(x, x, half, BITS);
    arb_mul(weight, weight, half, BITS);
    arb_clear(half);
}

/* Adds one node; `weight` includes both rules' weights. */
static void add_node(arb_ptr sums, const reflection *r, const arb_t t, const arb_t p,
                     const arb_t weight) {
    arb_ptr w = _arb_vec_init(3);
    arb_t s, c, f, y;
    arb_init(s);
    arb_init(c);
    arb_init(f);
    arb_init(y);
    arb_sin_cos(w + 1, c, t, BITS);
    arb_sin_cos(w, w + 2, p, BITS);
    arb_mul(w, w, c, BITS);
    arb_mul(w + 2, w + 2, c, BITS);
    /* cos(p + view) cos t is w·r */
    arb_set_d(f, r->view);
    arb_add(f, f, p, BITS);
    arb_cos(f, f, BITS);
    arb_mul(f, f, c, BITS);
    arb_pow_ui(f, f, (ulong)r->exponent, BITS);
    arb_mul(f, f, w + 2, BITS);
    arb_mul(f, f, c, BITS);
    arb_mul(f, f, weight, BITS);
    for (int l = 0, k = 0; l < BANDS; l++)
        for (int m = 0; m <= l; m++, k++) {
            harmonics_at_real(y, l, m, w);
            arb_addmul(sums + k, y, f, BITS);
        }
    arb_clear(s);
    arb_clear(c);
    arb_clear(f);
    arb_clear(y);
    _arb_vec_clear(w, 3);
}

static void integrate(arb_ptr sums, const reflection *r) {
    const int n = r->exponent > 20 ? MOST : LEAST;
    arb_t right, left, upper, view, t, p, weight, other;
    arb_init(right);
    arb_init(left);
    arb_init(upper);
    arb_init(view);
    arb_init(t);
    arb_init(p);
    arb_init(weight);
    arb_init(other);
    arb_const_pi(right, BITS);
    arb_mul_2exp_si(right, right, -1);
    arb_neg(left, right);
    arb_set_d(view, r->view);
    arb_set(upper, right);
    if (r->exponent > 0)
        arb_sub(upper, right, view, BITS);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            node_of(t, weight, n, i, left, right);
            node_of(p, other, n, j, left, upper);
            arb_mul(weight, weight, other, BITS);
            add_node(sums, r, t, p, weight);
        }
    arb_clear(right);
    arb_clear(left);
    arb_clear(upper);
    arb_clear(view);
    arb_clear(t);
    arb_clear(p);
    arb_clear(weight);
    arb_clear(other);
}

void vectors_table_header(void) {
    printf("exponent,theta_o,");
    for (int l = 0; l < BANDS; l++)
        for (int m = 0; m <= l; m++)
            printf("T_%d_%d,", l, m);
    printf("bound\n");
}

/* Exponent 0 is diffuse, 1/pi; others are (e + 2)/(2 pi) max(w·r, 0)^e. */
void vectors_table_row(int row) {
    static const int exponents[4] = { 0, 1, 10, 60 };
    const reflection r = { exponents[(row - 1) % 4], (row - 1) / 4 * 0.375 };
    const double inputs[2] = { r.exponent, r.view };
    arb_ptr sums = _arb_vec_init(COUNT);
    arb_t pi;
    mag_t bound;
    arb_init(pi);
    mag_init(bound);
    vectors_print_inputs(inputs, 2);
    integrate(sums, &r);
    arb_const_pi(pi, BITS);
    arb_mul_2exp_si(pi, pi, 1);
    mag_set_d(bound, 1e-18);
    for (int k = 0; k < COUNT; k++) {
        arb_mul_si(sums + k, sums + k, r.exponent > 0 ? r.exponent + 2 : 2, BITS);
        arb_div(sums + k, sums + k, pi, BITS);
        vectors_print_value(sums + k, bound);
    }
    vectors_print_bound(bound);
    arb_clear(pi);
    mag_clear(bound);
    _arb_vec_clear(sums, COUNT);
}
