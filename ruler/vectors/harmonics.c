/* SPDX-License-Identifier: MIT */
#include "ruler/vectors/harmonics.h"

#include <acb_hypgeom.h>
#include <arb_hypgeom.h>
#include <stdlib.h>

#define BITS VECTORS_PRECISION

/* --- the basis -------------------------------------------------------------------------------- */

/* e^(i phi) = (x + iy)/s is given, not phi: Y_l^|m| at phi 0 is multiplied by cos m phi or sin m
 * phi. */
void harmonics_at(acb_t value, int l, int m, acb_srcptr w) {
    acb_t s, theta, power, other, zero;
    acb_init(s);
    acb_init(theta);
    acb_init(power);
    acb_init(other);
    acb_init(zero);
    acb_mul(s, w, w, BITS);
    acb_addmul(s, w + 1, w + 1, BITS);
    acb_sqrt(s, s, BITS);
    if (acb_is_zero(s)) {
        /* At a pole the argument of a ball that contains 0 could be any angle. */
        arb_atan2(acb_realref(theta), acb_realref(s), acb_realref(w + 2), BITS);
        acb_one(power);
    } else {
        /* theta = -i log((z + is)/r) */
        acb_mul_onei(theta, s);
        acb_add(theta, theta, w + 2, BITS);
        acb_mul(other, s, s, BITS);
        acb_addmul(other, w + 2, w + 2, BITS);
        acb_sqrt(other, other, BITS);
        acb_div(theta, theta, other, BITS);
        acb_log(theta, theta, BITS);
        acb_div_onei(theta, theta);
        acb_mul_onei(power, w + 1);
        acb_add(power, power, w, BITS);
        acb_div(power, power, s, BITS);
    }
    acb_hypgeom_spherical_y(value, l, abs(m), theta, zero, BITS);
    if (m != 0) {
        acb_pow_ui(power, power, (ulong)abs(m), BITS);
        acb_inv(other, power, BITS);
        (m > 0 ? acb_add : acb_sub)(power, power, other, BITS);
        acb_mul(value, value, power, BITS);
        if (m < 0)
            acb_div_onei(value, value);
        acb_set_ui(other, 2);
        acb_rsqrt(other, other, BITS);
        acb_mul(value, value, other, BITS);
    }
    acb_clear(s);
    acb_clear(theta);
    acb_clear(power);
    acb_clear(other);
    acb_clear(zero);
}

void harmonics_at_real(arb_t value, int l, int m, arb_srcptr w) {
    acb_ptr wide = _acb_vec_init(3);
    acb_t y;
    acb_init(y);
    for (int k = 0; k < 3; k++)
        acb_set_arb(wide + k, w + k);
    harmonics_at(y, l, m, wide);
    arb_set(value, acb_realref(y));
    acb_clear(y);
    _acb_vec_clear(wide, 3);
}

/* --- caps ------------------------------------------------------------------------------------- */

static void legendre(acb_t value, int l, const acb_t x) {
    acb_t degree, order;
    acb_init(degree);
    acb_init(order);
    acb_set_si(degree, l);
    acb_hypgeom_legendre_p(value, degree, order, x, 0, BITS);
    acb_clear(degree);
    acb_clear(order);
}

void harmonics_cap(acb_t value, int l, const acb_t cosine) {
    acb_t next;
    arb_t pi;
    acb_init(next);
    arb_init(pi);
    if (l == 0) {
        acb_sub_ui(value, cosine, 1, BITS);
        acb_neg(value, value);
    } else {
        legendre(value, l - 1, cosine);
        legendre(next, l + 1, cosine);
        acb_sub(value, value, next, BITS);
        acb_div_ui(value, value, (ulong)(2 * l + 1), BITS);
    }
    arb_const_pi(pi, BITS);
    arb_mul_2exp_si(pi, pi, 1);
    acb_mul_arb(value, value, pi, BITS);
    acb_clear(next);
    arb_clear(pi);
}

void harmonics_sphere(acb_t value, int l, int m, const double center[3], double radius, int k,
                      const acb_t t) {
    acb_ptr w = _acb_vec_init(3);
    acb_t squared, ratio, y;
    acb_init(squared);
    acb_init(ratio);
    acb_init(y);
    for (int i = 0; i < 3; i++)
        acb_set_d(w + i, center[i]);
    acb_sub(w + k, w + k, t, BITS);
    acb_dot(squared, NULL, 0, w, 1, w, 1, 3, BITS);
    acb_set_d(ratio, radius);
    acb_mul(ratio, ratio, ratio, BITS);
    arf_t border;
    arf_init(border);
    arf_set_d(border, radius);
    arf_mul(border, border, border, ARF_PREC_EXACT, ARF_RND_DOWN);
    const int inside = arf_cmp(arb_midref(acb_realref(squared)), border) < 0;
    arf_clear(border);
    if (inside)
        acb_div(ratio, squared, ratio, BITS);
    else
        acb_div(ratio, ratio, squared, BITS);
    acb_sub_ui(ratio, ratio, 1, BITS);
    acb_neg(ratio, ratio);
    acb_sqrt(ratio, ratio, BITS);
    if (inside)
        acb_neg(ratio, ratio);
    harmonics_cap(value, l, ratio);
    /* At its center a sphere looks the same in all directions. */
    if (acb_is_zero(squared))
        acb_one(w + 2);
    harmonics_at(y, l, m, w);
    acb_mul(value, value, y, BITS);
    acb_clear(squared);
    acb_clear(ratio);
    acb_clear(y);
    _acb_vec_clear(w, 3);
}

/* |f'''| <= 6 M/rho³ within rho/2 or less of 0 where |f| <= M within rho, so that the difference is
 * off by h² M / (rho - h)³ at most. */
void harmonics_sphere_derivative(arb_t value, int l, int m, const double center[3], double radius,
                                 int k) {
    enum { STEP = 220, REACH = 72 }; /* h and rho, as bits after the point */
    acb_t t, ahead, behind;
    arb_t most;
    acb_init(t);
    acb_init(ahead);
    acb_init(behind);
    arb_init(most);
    mag_set_ui_2exp_si(arb_radref(acb_realref(t)), 1, -REACH);
    mag_set_ui_2exp_si(arb_radref(acb_imagref(t)), 1, -REACH);
    harmonics_sphere(ahead, l, m, center, radius, k, t);
    acb_abs(most, ahead, BITS);
    arb_get_abs_ubound_arf(arb_midref(most), most, BITS);
    mag_zero(arb_radref(most));
    arb_mul_2exp_si(most, most, 3 * REACH + 1 - 2 * STEP);
    acb_one(t);
    acb_mul_2exp_si(t, t, -STEP);
    harmonics_sphere(ahead, l, m, center, radius, k, t);
    acb_neg(t, t);
    harmonics_sphere(behind, l, m, center, radius, k, t);
    acb_sub(ahead, ahead, behind, BITS);
    acb_mul_2exp_si(ahead, ahead, STEP - 1);
    arb_set(value, acb_realref(ahead));
    arb_add_error(value, most);
    acb_clear(t);
    acb_clear(ahead);
    acb_clear(behind);
    arb_clear(most);
}

/* --- quadrature ------------------------------------------------------------------------------- */

void harmonics_integrate(arb_t value, int n, harmonics_function *f, void *user) {
    arb_ptr w = _arb_vec_init(3);
    arb_t weight, s, term, angle;
    arb_init(weight);
    arb_init(s);
    arb_init(term);
    arb_init(angle);
    arb_zero(value);
    for (int i = 0; i < n; i++) {
        arb_hypgeom_legendre_p_ui_root(w + 2, weight, (ulong)n, (ulong)i, BITS);
        arb_mul(s, w + 2, w + 2, BITS);
        arb_sub_ui(s, s, 1, BITS);
        arb_neg(s, s);
        arb_sqrt(s, s, BITS);
        for (int j = 0; j < 2 * n; j++) {
            arb_set_si(angle, j);
            arb_div_si(angle, angle, n, BITS);
            arb_sin_cos_pi(w + 1, w, angle, BITS);
            arb_mul(w, w, s, BITS);
            arb_mul(w + 1, w + 1, s, BITS);
            f(term, w, user);
            arb_addmul(value, term, weight, BITS);
        }
    }
    arb_const_pi(angle, BITS);
    arb_mul(value, value, angle, BITS);
    arb_div_si(value, value, n, BITS);
    arb_clear(weight);
    arb_clear(s);
    arb_clear(term);
    arb_clear(angle);
    _arb_vec_clear(w, 3);
}
