/* SPDX-License-Identifier: MIT */
/* packed_light.h - lights in the form that kernels, shading, fields, shadows and shaders use. */
#ifndef LAMPION_KERNELS_PACKED_LIGHT_H
#define LAMPION_KERNELS_PACKED_LIGHT_H

#include <lampion/base.h>

#include <math.h>

/* Stands for the radius or angle of a Dirac, a light of size 0. Its square exceeds that of any
 * distance, so kernels that know only spheres find every point inside the light, and take their
 * slow path. LMPI_DIRAC_DISTANCE_MIN is the distance beyond which the light of a Dirac with a
 * position falls off. */
#define LMPI_DIRAC              (-INFINITY)
#define LMPI_DIRAC_DISTANCE_MIN 1e-6f

/* The form of a light, once its kind has been examined (src/light/packed.h): kernels, shading,
 * fields, shadows and shaders know only these forms. Of areas, kernels take the flat ones (flat.h),
 * and src/light/seen.h sums the others one by one, in the same way for every instruction set. */
typedef enum lmpi_light_form {
    LMPI_FORM_SPHERE, /* a sphere around a position */
    LMPI_FORM_DIRAC,  /* a single direction, to a position or fixed */
    LMPI_FORM_CONE,   /* a Dirac at a position that falls off around an axis */
    LMPI_FORM_CAP,    /* fixed, of at most a hemisphere, with ambient light besides */
    LMPI_FORM_AREA    /* around a position, with an outline (src/light/area.h) */
} lmpi_light_form;

typedef struct lmpi_packed_light {
    lmpi_light_form form;
    int fixed; /* looks the same from every point: `at` is its unit direction, else its position */
    lmp_vec3 at;
    float size;      /* a radius; 1 - cos a of a cap, 0 … 1; LMPI_DIRAC for Diracs and cones */
    lmp_rgb color;   /* radiance; intensity of Diracs and cones; irradiance of fixed Diracs */
    lmp_rgb ambient; /* radiance from every direction; only a cap has any */
    float per_reach; /* 1/reach if only the part that no field holds is summed, else 0 */
    /* Only for cones: the axis, pointing away from the light, the cosine of the outer angle, and
     * the cosine of the inner angle minus that. */
    lmp_vec3 axis;
    float outer, width;
} lmpi_packed_light;

#endif
