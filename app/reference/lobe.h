/* SPDX-License-Identifier: MIT */
/* lobe.h - materials as lobes, in double. A lobe is weight (e+1)/(2 pi) max(q·w, 0)^e around an
 * axis q; the diffuse lobe albedo/pi max(n·w, 0) is the one with e = 1. */
#ifndef LAMPION_REFERENCE_LOBE_H
#define LAMPION_REFERENCE_LOBE_H

#include "app/reference/ggx.h"
#include "app/reference/series.h"
#include "app/reference/sheen.h"
#include "app/reference/tabulated.h"

#include <lampion/sh.h>

/* The meaning of lmp_material's lobes in double. */
typedef struct reference_material {
    double diffuse[3], specular[3];
    double exponent;
} reference_material;

typedef struct reference_lobe {
    reference_vec axis;
    double weight[3];
    double exponent;
    const reference_ggx *ggx;     /* of which it is a guide only; or NULL */
    int bands;                    /* of series; 0 = whole */
    double series[LMP_BANDS_MAX]; /* factors of P_l(q·w) */
} reference_lobe;

/* What a surface is to the integrator. */
#define REFERENCE_LOBES 4
typedef struct reference_surface {
    reference_vec position;
    reference_vec ray_origin; /* where rays towards lights start; clear of the surface itself */
    reference_lobe lobes[REFERENCE_LOBES]; /* diffuse, specular, of layers */
    int lobe_count;
    double occluded;   /* the part of the environment's light that an occlusion map keeps off */
    bool band_limited; /* they, or the tabulated material, are a truncated series */
    /* One of these reflects instead of the lobes, which then only guide the samples; or none. */
    const reference_tabulated *tabulated;
    const reference_ggx *ggx;
    const reference_sheen *sheen; /* over ggx, which has what it leaves; or NULL */
    const reference_ggx *coat;    /* over both */
    double under;                 /* the part of the light that the coat leaves */
    reference_band_limit limit;   /* of ggx: a series is made of the lights */
} reference_surface;

/* normal and view must be unit; ray_origin becomes the position. */
void reference_surface_set(reference_surface *surface, const reference_band_limit *limit,
                           const reference_material *material, reference_vec position,
                           reference_vec normal, reference_vec view);

/* Makes the surface reflect as `ggx`, or as it in the bands of the limit. */
void reference_surface_shine(reference_surface *surface, const reference_band_limit *limit,
                             const reference_ggx *ggx, reference_vec normal, reference_vec view);

/* Puts fibers over it. */
void reference_surface_sheen(reference_surface *surface, const reference_sheen *sheen);

/* Puts a coat over it all (reference_coat_set); `view` as before. */
void reference_surface_coat(reference_surface *surface, const reference_ggx *coat,
                            reference_vec normal, reference_vec view);

/* Makes the surface reflect as `tabulated`, oriented already. */
void reference_surface_measure(reference_surface *surface, const reference_tabulated *tabulated,
                               reference_vec normal, reference_vec view);

/* The lobe without its weight, at q·w = cosine. */
double reference_lobe_at(const reference_lobe *lobe, double cosine);

#endif
