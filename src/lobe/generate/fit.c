/* SPDX-License-Identifier: MIT */
#include "src/lobe/generate/fit.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define SMALL 1e-3 /* pulls weights to 0, so that lobes that nearly cancel stay small */

/* Computes the mean of lobes as the table is interpolated: it holds spreads, and a fit their logs.
 */
void fit_mean(const double *const *lobes, int count, double mean[PARAMETERS],
              double chain[PARAMETERS]) {
    for (int i = 0; i < PARAMETERS; i++) {
        const bool log_of = i % 4 == 1;
        double sum = 0;
        for (int k = 0; k < count; k++)
            sum += log_of ? exp(lobes[k][i]) : lobes[k][i];
        mean[i] = log_of ? log(sum / count) : sum / count;
        chain[i] = log_of ? exp(lobes[0][i]) / sum : 1. / count;
    }
}

static void accumulate(const fit_problem *problem, const double p[PARAMETERS], equations *e) {
    static const double scale[4] = { 1, 0.5, 2, 2 };
    memset(e, 0, sizeof *e);
    for (int t = 0; t < problem->count; t++) {
        const fit_term *term = &problem->terms[t];
        const double *lobes[1 + FIT_OTHERS_MAX] = { p };
        double mean[PARAMETERS], chain[PARAMETERS];
        for (int k = 0; k < term->count; k++)
            lobes[1 + k] = term->others[k];
        fit_mean(lobes, 1 + term->count, mean, chain);
        node_add(term->node, mean, chain, term->weight, e);
    }
    for (int i = 0; i < PARAMETERS; i++) {
        double row[PARAMETERS] = { 0 };
        row[i] = problem->pull * scale[i % 4];
        equations_add(e, row, row[i] * (p[i] - problem->toward[i]));
        row[i] = i % 4 >= 2 ? SMALL : 0;
        equations_add(e, row, row[i] * p[i]);
    }
}

/* Solves (matrix + damping diagonal) x = vector by Cholesky; returns false if it is not definite.
 */
static bool solve(const equations *e, double damping, double x[PARAMETERS]) {
    double l[PARAMETERS][PARAMETERS];
    for (int i = 0; i < PARAMETERS; i++)
        for (int k = 0; k <= i; k++) {
            double sum = e->matrix[i][k] * (i == k ? 1 + damping : 1) + (i == k ? 1e-15 : 0);
            for (int j = 0; j < k; j++)
                sum -= l[i][j] * l[k][j];
            if (i == k && !(sum > 0))
                return false;
            l[i][k] = i == k ? sqrt(sum) : sum / l[k][k];
        }
    for (int i = 0; i < PARAMETERS; i++) {
        x[i] = e->vector[i];
        for (int k = 0; k < i; k++)
            x[i] -= l[i][k] * x[k];
        x[i] /= l[i][i];
    }
    for (int i = PARAMETERS - 1; i >= 0; i--) {
        for (int k = i + 1; k < PARAMETERS; k++)
            x[i] -= l[k][i] * x[k];
        x[i] /= l[i][i];
    }
    return true;
}

/* Keeps parameters at a bound that a step would take past it. */
static void equations_bound(const fit_problem *problem, equations *e, const double p[PARAMETERS]) {
    for (int i = 0; i < PARAMETERS; i++) {
        const bool low = p[i] <= problem->least[i] && e->vector[i] < 0;
        const bool high = p[i] >= problem->most[i] && e->vector[i] > 0;
        if (!low && !high)
            continue;
        for (int k = 0; k < PARAMETERS; k++)
            e->matrix[i > k ? i : k][i > k ? k : i] = i == k;
        e->vector[i] = 0;
    }
}

void fit_improve(const fit_problem *problem, double p[PARAMETERS], int steps) {
    equations now, next;
    double damping = 1e-3, step[PARAMETERS], tried[PARAMETERS];
    for (int k = 0; k < PARAMETERS; k++)
        p[k] = fmin(fmax(p[k], problem->least[k]), problem->most[k]);
    accumulate(problem, p, &now);
    equations_bound(problem, &now, p);
    for (int i = 0; i < steps && damping < 1e6; i++) {
        if (!solve(&now, damping, step)) {
            damping *= 10;
            continue;
        }
        for (int k = 0; k < PARAMETERS; k++)
            tried[k] = fmin(fmax(p[k] + step[k], problem->least[k]), problem->most[k]);
        accumulate(problem, tried, &next);
        if (next.error < now.error) {
            const bool done = next.error > now.error * (1 - 1e-5);
            memcpy(p, tried, sizeof tried);
            equations_bound(problem, &next, p);
            now = next;
            damping = fmax(damping / 5, 1e-9);
            if (done)
                break;
        } else {
            damping *= 4;
        }
    }
}
