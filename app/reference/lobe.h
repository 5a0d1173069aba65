/* SPDX-License-Identifier: MIT */
/* lobe.h - materials as lobes, in double. A lobe is weight (e+1)/(2 pi) max(q·w, 0)^e around an
 * axis q; the diffuse lobe albedo/pi max(n·w, 0) is the one with e = 1. */
#ifndef LAMPION_REFERENCE_LOBE_H
#define LAMPION_REFERENCE_LOBE_H

#include "app/reference/tabulated.h"

#include <lampion/sh.h>

/* The meaning of lmp_material in double. */
typedef struct reference_material {
    double diffuse[3], specular[3];
    double exponent;
} reference_material;

/* glTF's metallic-roughness as two lobes, as <lampion/shade.h> defines it. */
reference_material reference_material_from_metallic_roughness(const double base[3], double metallic,
                                                              double roughness);

/* Band limit of the lobes. Zero: none, the lobes themselves. */
typedef struct reference_band_limit {
    int bands; /* 0, or 1 … LMP_BANDS_MAX */
    lmp_window window;
    double window_size; /* 0 means bands */
} reference_band_limit;

typedef struct reference_lobe {
    reference_vec axis;
    double weight[3];
    double exponent;
    int bands;                    /* of series; 0 = whole */
    double series[LMP_BANDS_MAX]; /* factors of P_l(q·w) */
} reference_lobe;

/* What a surface is to the integrator. */
#define REFERENCE_LOBES 2
typedef struct reference_surface {
    reference_vec position;
    reference_vec ray_origin; /* where rays towards lights start; clear of the surface itself */
    reference_lobe lobes[REFERENCE_LOBES]; /* diffuse, specular */
    bool band_limited; /* they, or the measured material, are a truncated series */
    const reference_tabulated *tabulated; /* reflects instead of the lobes, or NULL: the lobes then
                                           only guide the samples */
} reference_surface;

/* normal and view must be unit; ray_origin becomes the position. */
void reference_surface_set(reference_surface *surface, const reference_band_limit *limit,
                           const reference_material *material, reference_vec position,
                           reference_vec normal, reference_vec view);

/* Makes the surface reflect as `tabulated`, oriented already. */
void reference_surface_measure(reference_surface *surface, const reference_tabulated *tabulated,
                               reference_vec normal, reference_vec view);

/* The lobe without its weight, at q·w = cosine. */
double reference_lobe_at(const reference_lobe *lobe, double cosine);

#endif
