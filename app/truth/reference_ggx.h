/* SPDX-License-Identifier: MIT */
/* reference_ggx.h - glTF's metallic-roughness at one surface point, exactly: glTF 2.0, appendix B
 * (GGX, Smith's height-correlated masking, Schlick's Fresnel term). No table of lobes is read. */
#ifndef LAMPION_TRUTH_REFERENCE_GGX_H
#define LAMPION_TRUTH_REFERENCE_GGX_H

#include "app/truth/reference_vector.h"

#include <stdbool.h>

typedef struct reference_ggx {
    double diffuse[3];          /* base color of the dielectric, times its weight */
    double f0[3], f90;          /* of metal and dielectric, mixed */
    double layer_f0, layer_f90; /* over the dielectric, by the most reflective channel */
    double alpha;
    reference_vec x, y, z; /* the frame: z is the normal */
    double view[3];        /* in the frame */
} reference_ggx;

/* The dielectric's reflectance along the normal and at grazing angles. */
typedef struct reference_dielectric {
    double f0[3], f90;
} reference_dielectric;

/* Prepares the BRDF; normal and view must be unit. A view below the horizon is treated as grazing,
 * and alpha is at least 0.001, because a mirror cannot be sampled. */
void reference_ggx_set(reference_ggx *ggx, const double base[3], double metallic, double roughness,
                       const reference_dielectric *dielectric, reference_vec normal,
                       reference_vec view);

/* Prepares a clear coat (KHR_materials_clearcoat): GGX with the Fresnel term of the view as f90. */
void reference_coat_set(reference_ggx *coat, double weight, double roughness, reference_vec normal,
                        reference_vec view);

/* Evaluates f_r cos(theta) for light from w. */
void reference_ggx_at(const reference_ggx *ggx, reference_vec w, double rgb[3]);

/* Sample a direction of light by the specular part (visible normals, Heitz 2018), from two random
 * numbers; and return its density, per steradian. */
reference_vec reference_ggx_draw(const reference_ggx *ggx, double u, double v);
double reference_ggx_density(const reference_ggx *ggx, reference_vec w);

/* Approximates the specular part at an angle from the mirror direction; never 0. */
double reference_ggx_near(double alpha, double cosine);

#endif
