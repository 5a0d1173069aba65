/* SPDX-License-Identifier: MIT */
/* node.h - what the lobes of one view and one roughness are fitted to, and how far they are from
 * GGX. */
#ifndef LAMPION_LOBE_GENERATE_NODE_H
#define LAMPION_LOBE_GENERATE_NODE_H

#include "src/lobe/generate/caps.h"
#include "src/lobe/ggx_table.h"

enum {
    LOBES = LMP_GGX_LOBES,
    PARAMETERS = 4 * LOBES, /* as in the table, but with the log of the spread */
    SIZES = 4,              /* of caps: about as wide as the lobe, a few times, many times */
    DISTANCES = 14,         /* of caps from the mirror direction */
    AZIMUTHS = 8,           /* of caps, on one side of the plane of incidence */
    CAPS = SIZES * DISTANCES * AZIMUTHS + 1, /* the last is the whole sky */
    MATERIALS = 2                            /* a white metal, and a dielectric over a gray base */
};

typedef struct fit_node {
    ggx_view view;
    const caps_table *tables;  /* [SIZES + 1] */
    double lost;               /* caps_diffuse */
    double direction[CAPS][2]; /* x and z of the caps' centers */
    double solid[CAPS];        /* weights of the caps in the energy */
    double target[MATERIALS][CAPS], weight[MATERIALS][CAPS];
    double base[MATERIALS][CAPS];      /* what is seen besides of a dielectric's base */
    double peak[MATERIALS][SIZES + 1]; /* peaks per size of caps */
} fit_node;

/* A least-squares problem, linear around some lobes. */
typedef struct equations {
    double matrix[PARAMETERS][PARAMETERS], vector[PARAMETERS], error;
} equations;

/* Returns the half angle of caps of a size; SIZES is the sky. */
double node_cap_size(double alpha, int size);

/* Creates a node. tables are those of node_cap_size(alpha, 0 … SIZES). */
void node_create(fit_node *node, double z, double alpha, const caps_table *tables);

void equations_add(equations *e, const double row[PARAMETERS], double residual);

/* Adds the errors of lobes p, which change by `chain` times as much as the unknown ones. */
void node_add(const fit_node *node, const double p[PARAMETERS], const double chain[PARAMETERS],
              double weight, equations *e);

/* Returns the rms error of lobes, relative to the peak. */
double node_error(const fit_node *node, const double p[PARAMETERS]);

#endif
