/* SPDX-License-Identifier: MIT */
/* ggx.h - glTF's metallic-roughness seen from one surface point, exactly: glTF 2.0, appendix B
 * (GGX, Smith's height-correlated masking, Schlick's Fresnel term). No table of lobes is read. */
#ifndef LAMPION_REFERENCE_GGX_H
#define LAMPION_REFERENCE_GGX_H

#include "app/reference/vector.h"

#include <stdbool.h>

typedef struct reference_ggx {
    double diffuse[3];          /* base color of the dielectric, times its fraction */
    double f0[3], f90;          /* of metal and dielectric, mixed */
    double layer_f0, layer_f90; /* over the dielectric: the most reflected channel is held back */
    double alpha;
    reference_vec x, y, z; /* z is the normal */
    double view[3];        /* in that frame */
} reference_ggx;

/* What the dielectric reflects along the normal and at grazing angles. */
typedef struct reference_dielectric {
    double f0[3], f90;
} reference_dielectric;

/* normal and view must be unit. A view below the horizon counts as grazing, alpha is held to 0.001
 * and up: a mirror cannot be sampled. */
void reference_ggx_set(reference_ggx *ggx, const double base[3], double metallic, double roughness,
                       const reference_dielectric *dielectric, reference_vec normal,
                       reference_vec view);

/* A clear coat (KHR_materials_clearcoat): GGX whose Fresnel term is that of the view, f90. */
void reference_coat_set(reference_ggx *coat, double weight, double roughness, reference_vec normal,
                        reference_vec view);

/* f_r cos(theta) of light from w. */
void reference_ggx_at(const reference_ggx *ggx, reference_vec w, double rgb[3]);

/* A direction of light as the specular part reflects it (visible normals, Heitz 2018), of two
 * random numbers; and its density, per steradian. */
reference_vec reference_ggx_draw(const reference_ggx *ggx, double u, double v);
double reference_ggx_density(const reference_ggx *ggx, reference_vec w);

/* About what the specular part is at an angle from the mirror direction; never 0. */
double reference_ggx_near(double alpha, double cosine);

#endif
