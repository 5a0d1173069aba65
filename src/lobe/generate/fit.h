/* SPDX-License-Identifier: MIT */
/* fit.h - lobes by least squares (Levenberg-Marquardt), at one node of the table and halfway to its
 * neighbors. */
#ifndef LAMPION_LOBE_GENERATE_FIT_H
#define LAMPION_LOBE_GENERATE_FIT_H

#include "src/lobe/generate/node.h"

enum { FIT_TERMS_MAX = 9, FIT_OTHERS_MAX = 3 };

/* What the mean of the unknown lobes and of others should follow, where the table is interpolated.
 */
typedef struct fit_term {
    const fit_node *node;
    const double *others[FIT_OTHERS_MAX];
    int count;
    double weight;
} fit_term;

typedef struct fit_problem {
    fit_term terms[FIT_TERMS_MAX];
    int count;
    double least[PARAMETERS], most[PARAMETERS];
    double toward[PARAMETERS], pull; /* pulls toward these lobes */
} fit_problem;

/* Computes the mean of lobes, and how it changes with the first of them. */
void fit_mean(const double *const *lobes, int count, double mean[PARAMETERS],
              double chain[PARAMETERS]);

/* Improves the lobes p by `steps` steps. */
void fit_improve(const fit_problem *problem, double p[PARAMETERS], int steps);

#endif
