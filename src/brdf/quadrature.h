/* SPDX-License-Identifier: MIT */
/* quadrature.h - projection of one view of a BRDF: Gauss-Legendre rings in z on [0, 1] times
 * uniform azimuths, the transforms done one after the other (azimuth, then Legendre). */
#ifndef LAMPION_BRDF_QUADRATURE_H
#define LAMPION_BRDF_QUADRATURE_H

#include "src/brdf/brdf.h"

typedef struct brdf_quadrature {
    int bands, rings, azimuths; /* azimuths = 2 rings, at half steps: symmetric under y -> -y */
    double *z, *weight;         /* [rings]; the weight includes z and 2 pi / azimuths */
    double *x, *y;              /* [azimuths]: cos phi, sin phi */
    double *cosine, *sine;      /* [azimuths][bands]: cosines and sines of m phi */
    double *legendre;           /* [rings][LMP_SH_HALF_COUNT(bands)]: Y_lm / cos(m phi), by m */
    void *block;
} brdf_quadrature;

/* Returns the index of coefficients with m >= 0 that are ordered by m: for each m the entries l = m
 * … bands-1 follow one another. */
static inline size_t brdf_half_index(int bands, int l, int m) {
    return (size_t)(m * bands - m * (m - 1) / 2 + l - m);
}

/* Makes a quadrature. The host must be resolved. */
lmp_result lmpi_brdf_quadrature_create(const lmp_host *host, int bands, int rings,
                                       brdf_quadrature *quadrature);
void lmpi_brdf_quadrature_destroy(const lmp_host *host, brdf_quadrature *quadrature);

/* Describes how a view is projected. */
typedef struct brdf_projection {
    const lmp_brdf *brdf;
    double view[3], rotation[2]; /* wo in the material's frame; cos, sin of the rotation of wi's */
    bool mirrored;               /* only m >= 0 is kept */
} brdf_projection;

/* Projects a view onto cosine and sine parts, [channel][LMP_SH_HALF_COUNT(bands)], ordered by m.
 * sine is not written if mirrored. */
void lmpi_brdf_project_view(const brdf_projection *projection, const brdf_quadrature *quadrature,
                            double *cosine, double *sine);

#endif
