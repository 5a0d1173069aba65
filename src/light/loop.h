/* SPDX-License-Identifier: MIT */
/* loop.h - what is seen of a light of uniform radiance, by the loop that bounds it.
 *
 * Each degree of the harmonics is an eigenfunction of the sphere's Laplacian, so its integral over
 * a region is one along the region's boundary, w(s) with g ds = w x dw:
 *
 *     ∫ Y_lm(w) dw   = 1/(l(l+1)) ∮ g · grad Y_lm(w) ds
 *     ∫ P_l(q·w) dw  = 1/2 ∮ (q·g) R_l(q·w) ds          R_l as in sphere.h
 *
 * for l >= 1. Boundaries are arcs of circles in space; an arc around the viewer is a straight edge.
 * Everything is in double, by roots and quotients that IEEE 754 rounds alike on every machine. */
#ifndef LAMPION_LIGHT_LOOP_H
#define LAMPION_LIGHT_LOOP_H

#include "src/light/arc.h"

/* The boundary of what is seen, counter-clockwise around `inner`: a unit direction within a right
 * angle of all that is seen. */
enum { LMPI_ARCS_MAX = 8 };
typedef struct lmpi_loop {
    lmpi_vector inner;
    int count;
    lmpi_arc arc[LMPI_ARCS_MAX];
    bool closed;
    double solid_angle; /* once closed */
} lmpi_loop;

void lmpi_loop_begin(lmpi_loop *loop, lmpi_vector inner);

/* Appends the straight edge from `from` to from + edge, of which neither end need be unit. normal
 * is from x edge, which a caller may know better than it can be computed. */
void lmpi_loop_add_edge(lmpi_loop *loop, lmpi_vector from, lmpi_vector edge, lmpi_vector normal);

/* Appends an arc around `center` that is not straight. */
void lmpi_loop_add_arc(lmpi_loop *loop, lmpi_vector center, lmpi_vector middle, lmpi_vector side,
                       double end);

/* Finds the angles of the edges, once everything is appended. */
void lmpi_loop_end(lmpi_loop *loop);

/* Completes the edges of a loop that has ended, and finds its solid angle. */
void lmpi_loop_close(lmpi_loop *loop);

/* Computes ∫ P_l(q·w) dw over what is seen of a closed loop, for l < bands; q must be unit. */
void lmpi_loop_moments(int bands, const lmpi_loop *loop, lmpi_vector q, double *moments);

/* Adds scale[c] times the coefficients of bands low … high-1 of a closed loop to each of the planes
 * that is not NULL; a plane holds only those bands. */
void lmpi_loop_add(int low, int high, const lmpi_loop *loop, const float scale[3],
                   float *const planes[3]);

/* Computes the derivatives of the coefficients of a closed loop with respect to the viewer's
 * position, as long as the loop is where it is in space: three planes of LMP_SH_COUNT(bands)
 * values, d/dx, d/dy, d/dz. */
void lmpi_loop_gradient(int bands, const lmpi_loop *loop, float *gradient);

/* Returns ∫ max(n·w, 0) dw over what is seen; the loop has ended, and need not be closed. */
double lmpi_loop_irradiance(const lmpi_loop *loop, lmpi_vector n);

#endif
