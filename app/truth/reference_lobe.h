/* SPDX-License-Identifier: MIT */
/* reference_lobe.h - materials as lobes, in double. A lobe is weight (e+1)/(2 pi) max(q·w, 0)^e
 * around an axis q; the diffuse lobe albedo/pi max(n·w, 0) is the one with e = 1. */
#ifndef LAMPION_TRUTH_REFERENCE_LOBE_H
#define LAMPION_TRUTH_REFERENCE_LOBE_H

#include "app/truth/reference_ggx.h"
#include "app/truth/reference_series.h"
#include "app/truth/reference_sheen.h"
#include "app/truth/reference_tabulated.h"

#include <lampion/sh.h>

/* A material of diffuse and Phong lobes, as lmp_material defines them, in double. */
typedef struct reference_material {
    double diffuse[3], specular[3];
    double exponent;
} reference_material;

typedef struct reference_lobe {
    reference_vec axis;
    double weight[3];
    double exponent;
    const reference_ggx *ggx;     /* NULL, or the GGX lobe that this lobe guides the sampling of */
    int bands;                    /* of the truncated series; 0: not truncated */
    double series[LMP_BANDS_MAX]; /* factors of P_l(q·w) */
} reference_lobe;

/* A surface point in the form that the integrator uses. */
#define REFERENCE_LOBES 5
typedef struct reference_surface {
    reference_vec position;
    reference_vec ray_origin; /* origin of rays toward lights, off the surface itself */
    reference_lobe lobes[REFERENCE_LOBES]; /* diffuse, specular, of layers, of light from behind */
    int lobe_count;
    double occluded;   /* fraction of the environment's light that an occlusion map removes */
    bool band_limited; /* whether the lobes, or the tabulated material, are truncated series */
    /* At most one of these reflects instead of the lobes, which then only guide sampling. */
    const reference_tabulated *tabulated;
    const reference_ggx *ggx;
    const reference_sheen *sheen; /* over ggx, which gets the light that is left; or NULL */
    const reference_ggx *coat;    /* over both */
    double under;                 /* fraction of the light that the coat transmits */
    bool translucent;             /* with ggx: whether light from behind is transmitted */
    double transmitted[3];        /* color of that light */
    reference_vec behind[2];      /* its normal, and the origin of rays toward it */
    reference_band_limit limit;   /* of ggx: lights are made series */
} reference_surface;

/* Prepares a surface of lobes; normal and view must be unit. ray_origin is set to the position. */
void reference_surface_set(reference_surface *surface, const reference_band_limit *limit,
                           const reference_material *material, reference_vec position,
                           reference_vec normal, reference_vec view);

/* Makes the surface reflect as `ggx`, truncated to the bands of the limit. */
void reference_surface_shine(reference_surface *surface, const reference_band_limit *limit,
                             const reference_ggx *ggx, reference_vec normal, reference_vec view);

/* Puts a sheen over the surface. */
void reference_surface_sheen(reference_surface *surface, const reference_sheen *sheen);

/* Puts a coat over everything (reference_coat_set); `view` as in reference_surface_set. */
void reference_surface_coat(reference_surface *surface, const reference_ggx *coat,
                            reference_vec normal, reference_vec view);

/* Adds diffuse transmission of light from behind, attenuated by all layers; rays toward it start at
 * `origin`. Call it after all layers. */
void reference_surface_transmit(reference_surface *surface, const double color[3],
                                reference_vec normal, reference_vec origin);

/* Makes the surface reflect as `tabulated`, which must be oriented already. */
void reference_surface_measure(reference_surface *surface, const reference_tabulated *tabulated,
                               reference_vec normal, reference_vec view);

/* Evaluates the lobe without its weight, at q·w = cosine. */
double reference_lobe_at(const reference_lobe *lobe, double cosine);

#endif
