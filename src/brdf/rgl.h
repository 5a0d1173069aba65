/* SPDX-License-Identifier: MIT */
/* rgl.h - what the reader and the writer of RGL tensor files share: the names of the format and the
 * remapping from normals to the unit square of the samples. */
#ifndef LAMPION_BRDF_RGL_H
#define LAMPION_BRDF_RGL_H

#include "src/brdf/brdf.h"

#define RGL_MAGIC      "tensor_file"
#define RGL_MAGIC_SIZE 12 /* NUL included */
#define RGL_HEADER     18 /* magic, two bytes of version, field count */
#define RGL_U8         1
#define RGL_F32        10

/* Interpolation between the slices of phi_i and theta_i. */
typedef struct rgl_slices {
    size_t index[4];
    double weight[4];
} rgl_slices;

/* Finds the slices around (theta_i, phi_i), clamped to the ends. */
rgl_slices lmpi_rgl_slices(const brdf_rgl *rgl, double theta, double phi);

/* Makes the cumulative tables of every slice of rgl->density and scales each to integral 1. Returns
 * the first slice whose integral is not positive, or phi_count * theta_count. */
size_t lmpi_rgl_accumulate(brdf_rgl *rgl);

/* Maps a normal's coordinates u to the unit square of samples (Dupuy and Jakob 2018, §4.2). */
void lmpi_rgl_warp(const brdf_rgl *rgl, const rgl_slices *slices, const double u[2], double s[2]);

/* Returns the bilinear value of a grid at s in the unit square. */
double lmpi_rgl_bilinear(const brdf_grid *grid, const double s[2]);

/* Return the angles of a unit vector, exact near the pole. */
double lmpi_rgl_theta(const double w[3]);

/* Evaluates f_r of two directions: the file's value over the cosine of the second. */
void lmpi_rgl_eval(const lmp_brdf *brdf, const double first[3], const double second[3],
                   double rgb[3]);

#endif
