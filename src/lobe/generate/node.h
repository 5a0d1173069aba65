/* SPDX-License-Identifier: MIT */
/* node.h - one node of the table: the lobes of a view and a roughness, by least squares
 * (Levenberg-Marquardt). */
#ifndef LAMPION_LOBE_GENERATE_NODE_H
#define LAMPION_LOBE_GENERATE_NODE_H

#include "src/lobe/generate/caps.h"
#include "src/lobe/ggx_table.h"

enum {
    LOBES = LMP_GGX_LOBES,
    PARAMETERS = 4 * LOBES, /* as in the table, but the log of the spread */
    SIZES = 3,              /* of caps: about as wide as the lobe, some times, many times */
    DISTANCES = 14,         /* of caps from the mirror direction */
    AZIMUTHS = 8,           /* of them, on one side of the plane of incidence */
    CAPS = SIZES * DISTANCES * AZIMUTHS + 1, /* the last is the whole sky */
    MATERIALS = 2 /* a white metal, and the Fresnel reflection of a dielectric */
};

typedef struct fit_node {
    ggx_view view;
    const caps_table *tables;  /* [SIZES + 1] */
    double direction[CAPS][2]; /* x and z of the middles of the caps */
    double solid[CAPS];        /* what their energy counts */
    double target[MATERIALS][CAPS], weight[MATERIALS][CAPS];
    double peak[MATERIALS][SIZES + 1]; /* of the targets of a size */
    double extra_max;                  /* largest weight of the lobes from LMP_GGX_LOBES_FEW on */
    double fit[PARAMETERS];
} fit_node;

/* Half angle of the caps of a size; SIZES is the sky. */
double node_cap_size(double alpha, int size);

/* tables: of node_cap_size(alpha, 0 … SIZES). */
void node_create(fit_node *node, double z, double alpha, double extra_max,
                 const caps_table *tables);

/* Improves the lobes p in so many steps, pulled toward others; the sum of squares, pull included.
 */
double node_fit(const fit_node *node, double p[PARAMETERS], const double toward[PARAMETERS],
                double pull, int steps);

/* rms error of node->fit, in parts of the peak. */
double node_error(const fit_node *node);

#endif
