/* SPDX-License-Identifier: MIT */
/* lobe.h - f_r cos of a material as an analytic function of polar coordinates around a pole. */
#ifndef LAMPION_RULER_LOBE_H
#define LAMPION_RULER_LOBE_H

#include "ruler/configuration.h"
#include "ruler/domain.h"

typedef struct ruler_lobe {
    ruler_material material;
    int exponent;       /* of a zonal lobe, around the pole */
    arb_t scale;        /* scale of a zonal lobe; alpha²/pi for GGX */
    arb_t diffuse, f0;  /* for GGX: base/pi, and Fresnel's reflectance along the normal */
    arb_t alpha2, rest; /* alpha², 1 - alpha² */
    arb_t view, sin_view, cos_view, view_root;
    arb_t azimuth; /* azimuth of the light, from the mirror direction's side */
} ruler_lobe;

void ruler_lobe_init(ruler_lobe *lobe);
void ruler_lobe_clear(ruler_lobe *lobe);
void ruler_lobe_set(ruler_lobe *lobe, const ruler_configuration *configuration);

/* Whether the lobe does not depend on the azimuth: then the pole is its axis, otherwise the normal.
 */
bool ruler_lobe_is_zonal(const ruler_lobe *lobe);

/* What all directions of a circle around the pole share. */
typedef struct ruler_ring {
    acb_t arc;             /* half of the arc */
    acb_t zonal, specular; /* factors; zonal is diffuse reflection without Fresnel's term */
    mag_t most;            /* a bound of |specular| */
    acb_t closest;         /* C */
    acb_t floor, height;   /* C E, H */
    acb_t spread;          /* sin theta sin view */
} ruler_ring;

void ruler_ring_init(ruler_ring *ring);
void ruler_ring_clear(ruler_ring *ring);

/* Sets the circle at x, with sin theta and all of the domain's factors. */
void ruler_ring_set(ruler_ring *ring, const ruler_lobe *lobe, const ruler_domain *domain,
                    const acb_t x);

/* Evaluates f_r cos times the factors of the circle, at azimuth + y arc, y from -1 to 1. */
void ruler_ring_at(acb_t value, const ruler_ring *ring, const ruler_lobe *lobe, const acb_t y);

/* Bounds the magnitude of ruler_ring_at for any y of the ball; infinite where it is not proven to
 * be analytic. */
void ruler_ring_bound(mag_t most, const ruler_ring *ring, const ruler_lobe *lobe, const acb_t y);

/* Evaluates f_r cos of one direction: theta from the pole, phi from the mirror direction's side. */
void ruler_lobe_at(arb_t value, const ruler_lobe *lobe, const arb_t theta, const arb_t phi);

#endif
