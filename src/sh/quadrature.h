/* SPDX-License-Identifier: MIT */
/* quadrature.h - nodes for exact integrals over the sphere, computed where they are used. */
#ifndef LAMPION_SH_QUADRATURE_H
#define LAMPION_SH_QUADRATURE_H

/* Finds node i, in ascending order from 0, of `count` Gauss-Legendre nodes on [-1, 1], and its
 * weight. */
void lmpi_gauss_legendre(int count, int i, double *node, double *weight);

#endif
