/* SPDX-License-Identifier: MIT */
#include "ruler/value.h"
#include "ruler/integrate.h"
#include "ruler/source.h"

#include <arb_hypgeom.h>
#include <math.h>

#define P               RULER_PRECISION
#define BANDS_PRECISION 400  /* bits, for Legendre polynomials of a narrow cap nearly cancel */
#define FLOOR           1e-6 /* fraction of the scale */
#define ROUNDS          8

double ruler_scale(const ruler_configuration *configuration) {
    ruler_source parts[RULER_SOURCES];
    double scale = 0;
    const int count = ruler_sources(configuration, parts);
    for (int k = 0; k < count; k++) {
        const double angle = arf_get_d(arb_midref(parts[k].angle.radians), ARF_RND_NEAR);
        const double sine = angle < acos(0) ? sin(angle) : 1;
        scale += arf_get_d(arb_midref(parts[k].strength), ARF_RND_NEAR) *
                 (parts[k].single ? 1 / acos(-1) : sine * sine);
        ruler_source_clear(&parts[k]);
    }
    return scale;
}

static void add_cap(arb_t value, const ruler_lobe *lobe, const ruler_pole *pole,
                    const ruler_source *source, double tolerance) {
    ruler_domain domains[RULER_DOMAINS];
    arb_t sum;
    arb_init(sum);
    for (int k = 0; k < RULER_DOMAINS; k++)
        ruler_domain_init(&domains[k]);
    const int count = ruler_domains_of_cap(&pole->light, &source->angle, domains);
    for (int k = 0; k < count; k++)
        ruler_integrate(sum, lobe, &domains[k], tolerance / RULER_DOMAINS);
    arb_addmul(value, sum, source->strength, P);
    for (int k = 0; k < RULER_DOMAINS; k++)
        ruler_domain_clear(&domains[k]);
    arb_clear(sum);
}

static void add_direction(arb_t value, const ruler_lobe *lobe, const ruler_pole *pole,
                          const ruler_source *source) {
    arb_t response, right;
    arb_init(response);
    arb_init(right);
    arb_const_pi(right, P);
    arb_mul_2exp_si(right, right, -1);
    if (arb_lt(pole->light.radians, right)) {
        ruler_lobe_at(response, lobe, pole->light.radians, lobe->azimuth);
        arb_addmul(value, response, source->strength, P);
    }
    arb_clear(response);
    arb_clear(right);
}

static void evaluate(arb_t value, const ruler_configuration *configuration, double tolerance) {
    ruler_source parts[RULER_SOURCES];
    ruler_lobe lobe;
    ruler_pole pole;
    ruler_lobe_init(&lobe);
    ruler_pole_init(&pole);
    ruler_lobe_set(&lobe, configuration);
    ruler_pole_set(&pole, configuration);
    arb_zero(value);
    const int count = ruler_sources(configuration, parts);
    for (int k = 0; k < count; k++) {
        if (parts[k].single)
            add_direction(value, &lobe, &pole, &parts[k]);
        else
            add_cap(value, &lobe, &pole, &parts[k], tolerance / RULER_SOURCES);
        ruler_source_clear(&parts[k]);
    }
    ruler_pole_clear(&pole);
    ruler_lobe_clear(&lobe);
}

/* The tolerance follows the value, which each round knows more exactly. */
void ruler_value(arb_t value, const ruler_configuration *configuration, double relative) {
    const double scale = ruler_scale(configuration);
    double tolerance = relative * scale / 10;
    for (int round = 0; round < ROUNDS; round++) {
        evaluate(value, configuration, tolerance);
        const double middle = arf_get_d(arb_midref(value), ARF_RND_NEAR);
        const double radius = mag_get_d(arb_radref(value));
        const double wanted = relative * fmax(middle - radius, FLOOR * scale);
        if (radius <= wanted)
            return;
        tolerance = fmin(wanted / 2, tolerance / 2);
    }
}

/* --- truncated -------------------------------------------------------------------------------- */

const int ruler_band_counts[RULER_BAND_COUNTS] = { 3, 5, 10, 20, 100 };

/* Sets (e+1) ∫ t^e P_l(t) dt over 0 … 1 = sqrt(pi) (e+1)! / (2^(e+1) G(1 + (e-l)/2) G((3 + e +
 * l)/2)), the Funk-Hecke factor of a lobe of integral 1. */
static void set_factor(arb_t factor, int exponent, int l) {
    arb_t term;
    arb_init(term);
    arb_const_sqrt_pi(factor, BANDS_PRECISION);
    arb_fac_ui(term, (ulong)exponent + 1, BANDS_PRECISION);
    arb_mul(factor, factor, term, BANDS_PRECISION);
    arb_mul_2exp_si(factor, factor, -exponent - 1);
    for (int k = 0; k < 2; k++) {
        arb_set_si(term, k ? 3 + exponent + l : 2 + exponent - l);
        arb_mul_2exp_si(term, term, -1);
        arb_rgamma(term, term, BANDS_PRECISION);
        arb_mul(factor, factor, term, BANDS_PRECISION);
    }
    arb_clear(term);
}

/* Adds ∫ P_l over the source, around its axis: 2 pi (P_(l-1) - P_(l+1))(cos a) / (2l+1) for a cap.
 */
static void add_zonal(arb_t zonal, const ruler_source *source, int l) {
    arb_t cosine, first, last;
    arb_init(cosine);
    arb_init(first);
    arb_init(last);
    arb_one(first);
    if (!source->single) {
        arb_cos(cosine, source->angle.radians, BANDS_PRECISION);
        if (l > 0)
            arb_hypgeom_legendre_p_ui(first, NULL, (ulong)l - 1, cosine, BANDS_PRECISION);
        arb_hypgeom_legendre_p_ui(last, NULL, (ulong)l + 1, cosine, BANDS_PRECISION);
        arb_sub(first, first, last, BANDS_PRECISION);
        arb_const_pi(last, BANDS_PRECISION);
        arb_mul(first, first, last, BANDS_PRECISION);
        arb_mul_2exp_si(first, first, 1);
        arb_div_ui(first, first, 2 * (ulong)l + 1, BANDS_PRECISION);
    }
    arb_addmul(zonal, first, source->strength, BANDS_PRECISION);
    arb_clear(cosine);
    arb_clear(first);
    arb_clear(last);
}

/* Multiplies a term by (1 + cos(pi l/n))/2. */
static void weigh(arb_t term, int l, int bands) {
    arb_t weight;
    arb_init(weight);
    arb_set_si(weight, l);
    arb_div_si(weight, weight, bands, BANDS_PRECISION);
    arb_cos_pi(weight, weight, BANDS_PRECISION);
    arb_add_ui(weight, weight, 1, BANDS_PRECISION);
    arb_mul_2exp_si(weight, weight, -1);
    arb_mul(term, term, weight, BANDS_PRECISION);
    arb_clear(weight);
}

void ruler_value_of_bands(arb_t value, const ruler_configuration *configuration, int bands,
                          bool hanning) {
    const int exponent = configuration->material == RULER_PHONG ? configuration->exponent : 1;
    ruler_source parts[RULER_SOURCES];
    ruler_pole pole;
    arb_t cosine, term, factor;
    arb_init(cosine);
    arb_init(term);
    arb_init(factor);
    ruler_pole_init(&pole);
    ruler_pole_set(&pole, configuration);
    arb_cos(cosine, pole.light.radians, BANDS_PRECISION);
    const int count = ruler_sources(configuration, parts);
    arb_zero(value);
    for (int l = 0; l < bands; l++) {
        arb_zero(term);
        for (int k = 0; k < count; k++)
            add_zonal(term, &parts[k], l);
        arb_hypgeom_legendre_p_ui(factor, NULL, (ulong)l, cosine, BANDS_PRECISION);
        arb_mul(term, term, factor, BANDS_PRECISION);
        set_factor(factor, exponent, l);
        arb_mul(term, term, factor, BANDS_PRECISION);
        if (hanning)
            weigh(term, l, bands);
        arb_addmul_ui(value, term, 2 * (ulong)l + 1, BANDS_PRECISION);
    }
    /* factors of the addition theorem, and the color */
    arb_const_pi(factor, BANDS_PRECISION);
    arb_mul_ui(factor, factor, 400, BANDS_PRECISION);
    arb_div(value, value, factor, BANDS_PRECISION);
    arb_mul_si(value, value, configuration->color, BANDS_PRECISION);
    for (int k = 0; k < count; k++)
        ruler_source_clear(&parts[k]);
    ruler_pole_clear(&pole);
    arb_clear(cosine);
    arb_clear(term);
    arb_clear(factor);
}
