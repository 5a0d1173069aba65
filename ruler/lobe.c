/* SPDX-License-Identifier: MIT */
/* glTF 2.0, appendix B: GGX's distribution D, Smith's height-correlated visibility V and Schlick's
 * Fresnel term, alpha the square of roughness. With phi the azimuth from the mirror direction's
 * side,
 *
 *     2 (v·h)² = C + Q,   C = 1 + cos(theta + view),   Q = sin theta sin view (1 - cos phi)
 *     D = alpha²/pi (1 + H/(C E + Q))²,   E = alpha² + (1 - alpha²) sin² T,
 *                                         H = (1 - alpha²) C cos² T,   T = (theta - view)/2
 *
 * which follow from (n·h)² = (n·l + n·v)² / (4 (v·h)²) and 2 (v·h)² = 1 + v·l. Only cosines near 1
 * cancel, and few terms occur twice, so that balls stay narrow at the peak, where E and Q are
 * small. */
#include "ruler/lobe.h"

#define P RULER_PRECISION

void ruler_lobe_init(ruler_lobe *lobe) {
    arb_init(lobe->scale);
    arb_init(lobe->diffuse);
    arb_init(lobe->f0);
    arb_init(lobe->alpha2);
    arb_init(lobe->rest);
    arb_init(lobe->view);
    arb_init(lobe->view_root);
    arb_init(lobe->sin_view);
    arb_init(lobe->cos_view);
    arb_init(lobe->azimuth);
}

void ruler_lobe_clear(ruler_lobe *lobe) {
    arb_clear(lobe->scale);
    arb_clear(lobe->diffuse);
    arb_clear(lobe->f0);
    arb_clear(lobe->alpha2);
    arb_clear(lobe->rest);
    arb_clear(lobe->view);
    arb_clear(lobe->view_root);
    arb_clear(lobe->sin_view);
    arb_clear(lobe->cos_view);
    arb_clear(lobe->azimuth);
}

static void set_degrees(arb_t radians, int hundredths) {
    arb_const_pi(radians, P);
    arb_mul_si(radians, radians, hundredths, P);
    arb_div_ui(radians, radians, 18000, P);
}

static void set_ratio(arb_t value, int numerator, int denominator) {
    arb_set_si(value, numerator);
    arb_div_si(value, value, denominator, P);
}

/* Sets color (e+1)/(2 pi) cos^e; a diffuse lobe is the one with e = 1. */
static void set_zonal(ruler_lobe *lobe, int exponent, int color) {
    arb_t pi;
    arb_init(pi);
    arb_const_pi(pi, P);
    set_ratio(lobe->scale, color * (exponent + 1), 200);
    arb_div(lobe->scale, lobe->scale, pi, P);
    lobe->exponent = exponent;
    arb_clear(pi);
}

static void set_ggx(ruler_lobe *lobe, const ruler_configuration *configuration) {
    const bool metal = configuration->material == RULER_METAL;
    arb_t pi;
    arb_init(pi);
    arb_const_pi(pi, P);
    set_ratio(lobe->alpha2, configuration->roughness, 1000);
    arb_pow_ui(lobe->alpha2, lobe->alpha2, 4, P);
    arb_sub_ui(lobe->rest, lobe->alpha2, 1, P);
    arb_neg(lobe->rest, lobe->rest);
    arb_div(lobe->scale, lobe->alpha2, pi, P);
    set_ratio(lobe->f0, metal ? configuration->color : 4, 100);
    set_ratio(lobe->diffuse, metal ? 0 : configuration->color, 100);
    arb_div(lobe->diffuse, lobe->diffuse, pi, P);
    set_degrees(lobe->view, configuration->view_angle);
    arb_sin_cos(lobe->sin_view, lobe->cos_view, lobe->view, P);
    arb_sqr(lobe->view_root, lobe->cos_view, P);
    arb_mul(lobe->view_root, lobe->view_root, lobe->rest, P);
    arb_add(lobe->view_root, lobe->view_root, lobe->alpha2, P);
    arb_sqrt(lobe->view_root, lobe->view_root, P);
    arb_clear(pi);
}

void ruler_lobe_set(ruler_lobe *lobe, const ruler_configuration *configuration) {
    lobe->material = configuration->material;
    set_degrees(lobe->azimuth, configuration->light_azimuth);
    if (ruler_lobe_is_zonal(lobe))
        set_zonal(lobe, lobe->material == RULER_PHONG ? configuration->exponent : 1,
                  configuration->color);
    else
        set_ggx(lobe, configuration);
}

bool ruler_lobe_is_zonal(const ruler_lobe *lobe) {
    return lobe->material == RULER_LAMBERT || lobe->material == RULER_PHONG;
}

void ruler_ring_init(ruler_ring *ring) {
    acb_init(ring->arc);
    acb_init(ring->zonal);
    acb_init(ring->specular);
    acb_init(ring->closest);
    mag_init(ring->most);
    acb_init(ring->floor);
    acb_init(ring->height);
    acb_init(ring->spread);
}

void ruler_ring_clear(ruler_ring *ring) {
    acb_clear(ring->arc);
    acb_clear(ring->zonal);
    acb_clear(ring->specular);
    acb_clear(ring->closest);
    mag_clear(ring->most);
    acb_clear(ring->floor);
    acb_clear(ring->height);
    acb_clear(ring->spread);
}

/* Computes sqrt(alpha² + (1 - alpha²) cos²). */
static void smith_root(acb_t root, const ruler_lobe *lobe, const acb_t cosine) {
    acb_sqr(root, cosine, P);
    acb_mul_arb(root, root, lobe->rest, P);
    acb_add_arb(root, root, lobe->alpha2, P);
    acb_sqrt_analytic(root, root, 1, P);
}

/* Sets scale V cos theta, V = 0.5 / (n·l root(n·v) + n·v root(n·l)), and the largest value it can
 * have. */
static void set_specular(ruler_ring *ring, const ruler_lobe *lobe, const acb_t cosine) {
    acb_t root, sum;
    mag_t least;
    acb_init(root);
    acb_init(sum);
    mag_init(least);
    acb_mul_arb(sum, cosine, lobe->view_root, P);
    smith_root(root, lobe, cosine);
    acb_mul_arb(root, root, lobe->cos_view, P);
    acb_add(sum, sum, root, P);
    acb_mul_2exp_si(sum, sum, 1);
    acb_mul_arb(root, cosine, lobe->scale, P);
    acb_get_mag_lower(least, sum);
    acb_get_mag(ring->most, root);
    mag_div(ring->most, ring->most, least);
    acb_div(ring->specular, root, sum, P);
    acb_clear(root);
    acb_clear(sum);
    mag_clear(least);
}

/* Sets C, C E, H and sin theta sin view. */
static void set_peak(ruler_ring *ring, const ruler_lobe *lobe, const acb_t theta,
                     const acb_t sine) {
    acb_t difference;
    acb_init(difference);
    acb_add_arb(ring->closest, theta, lobe->view, P);
    acb_cos(ring->closest, ring->closest, P);
    acb_add_ui(ring->closest, ring->closest, 1, P);
    acb_sub_arb(difference, theta, lobe->view, P);
    acb_cos(difference, difference, P);
    acb_add_ui(ring->height, difference, 1, P);
    acb_sub_ui(difference, difference, 1, P);
    acb_neg(difference, difference);
    acb_mul_arb(ring->height, ring->height, lobe->rest, P);
    acb_mul_arb(ring->floor, difference, lobe->rest, P);
    acb_mul_2exp_si(ring->height, ring->height, -1);
    acb_mul_2exp_si(ring->floor, ring->floor, -1);
    acb_add_arb(ring->floor, ring->floor, lobe->alpha2, P);
    acb_mul(ring->height, ring->height, ring->closest, P);
    acb_mul(ring->floor, ring->floor, ring->closest, P);
    acb_mul_arb(ring->spread, sine, lobe->sin_view, P);
    acb_clear(difference);
}

static void set_factors(ruler_ring *ring, const ruler_lobe *lobe, const acb_t theta,
                        const acb_t sine, const acb_t cosine) {
    if (ruler_lobe_is_zonal(lobe)) {
        acb_pow_si(ring->zonal, cosine, lobe->exponent, P);
        acb_mul_arb(ring->zonal, ring->zonal, lobe->scale, P);
        return;
    }
    acb_mul_arb(ring->zonal, cosine, lobe->diffuse, P);
    set_specular(ring, lobe, cosine);
    set_peak(ring, lobe, theta, sine);
}

void ruler_ring_set(ruler_ring *ring, const ruler_lobe *lobe, const ruler_domain *domain,
                    const acb_t x) {
    acb_t theta, stretch, sine, cosine;
    acb_init(theta);
    acb_init(stretch);
    acb_init(sine);
    acb_init(cosine);
    ruler_domain_at(domain, x, theta, stretch, ring->arc);
    acb_sin_cos(sine, cosine, theta, P);
    set_factors(ring, lobe, theta, sine, cosine);
    acb_mul(stretch, stretch, sine, P);
    acb_mul(stretch, stretch, ring->arc, P);
    acb_mul(ring->zonal, ring->zonal, stretch, P);
    acb_mul(ring->specular, ring->specular, stretch, P);
    mag_t factor;
    mag_init(factor);
    acb_get_mag(factor, stretch);
    mag_mul(ring->most, ring->most, factor);
    mag_clear(factor);
    acb_clear(theta);
    acb_clear(stretch);
    acb_clear(sine);
    acb_clear(cosine);
}

/* Computes Q. */
static void set_across(acb_t across, const ruler_ring *ring, const acb_t phi) {
    acb_cos(across, phi, P);
    acb_sub_ui(across, across, 1, P);
    acb_neg(across, across);
    acb_mul(across, across, ring->spread, P);
}

/* Computes (v·h - 1)^5. */
static void set_schlick(acb_t schlick, const ruler_ring *ring, const acb_t across) {
    acb_add(schlick, across, ring->closest, P);
    acb_mul_2exp_si(schlick, schlick, -1);
    acb_sqrt_analytic(schlick, schlick, 1, P);
    acb_sub_ui(schlick, schlick, 1, P);
    acb_pow_ui(schlick, schlick, 5, P);
}

/* Computes zonal (1 - F) + specular (1 + H/(C E + Q))² F, with F = f0 + (1 - f0)(1 - v·h)^5. */
static void set_ggx_value(acb_t value, const ruler_ring *ring, const ruler_lobe *lobe,
                          const acb_t phi) {
    acb_t across, peak, fresnel;
    acb_init(across);
    acb_init(peak);
    acb_init(fresnel);
    set_across(across, ring, phi);
    acb_add(peak, across, ring->floor, P);
    acb_div(peak, ring->height, peak, P);
    acb_add_ui(peak, peak, 1, P);
    acb_sqr(peak, peak, P);
    acb_mul(peak, peak, ring->specular, P);
    set_schlick(across, ring, across);
    acb_mul_arb(fresnel, across, lobe->f0, P);
    acb_sub(fresnel, fresnel, across, P);
    acb_add_arb(fresnel, fresnel, lobe->f0, P);
    acb_sub(peak, peak, ring->zonal, P);
    acb_mul(value, peak, fresnel, P);
    acb_add(value, value, ring->zonal, P);
    acb_clear(across);
    acb_clear(peak);
    acb_clear(fresnel);
}

/* Bounds the value of set_ggx_value by the sizes of its terms: a quotient of wide balls would be
 * far wider. */
static void bound_ggx(mag_t most, const ruler_ring *ring, const ruler_lobe *lobe, const acb_t phi) {
    acb_t across, term;
    mag_t least, fresnel;
    acb_init(across);
    acb_init(term);
    mag_init(least);
    mag_init(fresnel);
    set_across(across, ring, phi);
    acb_add(term, across, ring->floor, P);
    acb_get_mag_lower(least, term);
    acb_get_mag(most, ring->height);
    mag_div(most, most, least);
    mag_one(least);
    mag_add(most, most, least);
    mag_mul(most, most, most);
    mag_mul(most, most, ring->most);
    set_schlick(term, ring, across);
    acb_mul_arb(across, term, lobe->f0, P);
    acb_sub(term, across, term, P);
    acb_add_arb(term, term, lobe->f0, P);
    acb_get_mag(fresnel, term);
    mag_mul(most, most, fresnel);
    acb_sub_ui(term, term, 1, P);
    acb_mul(term, term, ring->zonal, P);
    acb_get_mag(least, term);
    mag_add(most, most, least);
    acb_clear(across);
    acb_clear(term);
    mag_clear(least);
    mag_clear(fresnel);
}

static void set_azimuth(acb_t phi, const ruler_ring *ring, const ruler_lobe *lobe, const acb_t y) {
    acb_mul(phi, ring->arc, y, P);
    acb_add_arb(phi, phi, lobe->azimuth, P);
}

void ruler_ring_bound(mag_t most, const ruler_ring *ring, const ruler_lobe *lobe, const acb_t y) {
    if (ruler_lobe_is_zonal(lobe)) {
        acb_get_mag(most, ring->zonal);
        return;
    }
    acb_t phi;
    acb_init(phi);
    set_azimuth(phi, ring, lobe, y);
    bound_ggx(most, ring, lobe, phi);
    acb_clear(phi);
}

void ruler_ring_at(acb_t value, const ruler_ring *ring, const ruler_lobe *lobe, const acb_t y) {
    if (ruler_lobe_is_zonal(lobe)) {
        acb_set(value, ring->zonal);
        return;
    }
    acb_t phi;
    acb_init(phi);
    set_azimuth(phi, ring, lobe, y);
    set_ggx_value(value, ring, lobe, phi);
    acb_clear(phi);
}

void ruler_lobe_at(arb_t value, const ruler_lobe *lobe, const arb_t theta, const arb_t phi) {
    ruler_ring ring;
    acb_t at, sine, cosine, azimuth;
    ruler_ring_init(&ring);
    acb_init(at);
    acb_init(sine);
    acb_init(cosine);
    acb_init(azimuth);
    acb_set_arb(at, theta);
    acb_set_arb(azimuth, phi);
    acb_sin_cos(sine, cosine, at, P);
    set_factors(&ring, lobe, at, sine, cosine);
    if (ruler_lobe_is_zonal(lobe))
        acb_get_real(value, ring.zonal);
    else {
        set_ggx_value(at, &ring, lobe, azimuth);
        acb_get_real(value, at);
    }
    ruler_ring_clear(&ring);
    acb_clear(at);
    acb_clear(sine);
    acb_clear(cosine);
    acb_clear(azimuth);
}
