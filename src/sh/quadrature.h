/* SPDX-License-Identifier: MIT */
/* quadrature.h - nodes for exact integrals over the sphere, found where they are used. */
#ifndef LAMPION_SH_QUADRATURE_H
#define LAMPION_SH_QUADRATURE_H

/* Node number i, from 0 ascending, of `count` Gauss-Legendre nodes on [-1, 1], and its weight. */
void lmp_gauss_legendre(int count, int i, double *node, double *weight);

#endif
