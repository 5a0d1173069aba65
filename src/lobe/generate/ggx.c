/* SPDX-License-Identifier: MIT */
/* Writes src/lobe/ggx_table.c to standard output, and how well it fits to standard error; takes a
 * minute and a half of one core.
 *
 * A node of the table, a view angle and a roughness, is a least-squares fit of Phong lobes to what
 * caps of three sizes and a whole sky reflect by glTF's GGX. The sizes follow the width of the
 * lobe, so that mirrors are fitted as closely as chalk. Nodes are first fitted along a path, each
 * from its neighbor's result, then again under a pull to the mean of their neighbors, which falls
 * from sweep to sweep: lobes keep their identity, and the table can be interpolated. */
#include "src/lobe/generate/node.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { VIEWS = LMP_GGX_VIEWS, ROUGHNESSES = LMP_GGX_ROUGHNESSES, SWEEPS = 10 };

/* --- the fits --------------------------------------------------------------------------------- */

static fit_node nodes[ROUGHNESSES][VIEWS];
static caps_table tables[ROUGHNESSES][SIZES + 1];

static double node_alpha(int row) {
    const double least = (double)LMP_GGX_ROUGHNESS_MIN;
    const double roughness = least + (1 - least) * row / (ROUGHNESSES - 1);
    return roughness * roughness;
}

/* Column VIEWS-1 is normal incidence. */
static double node_z(int column) {
    const double root = (double)column / (VIEWS - 1);
    return root * root;
}

static void fit_from(int row, int column, int row_from, int column_from) {
    fit_node *to = &nodes[row][column];
    double toward[PARAMETERS];
    memcpy(toward, nodes[row_from][column_from].fit, sizeof toward);
    memcpy(to->fit, toward, sizeof toward);
    node_fit(to, to->fit, toward, 3e-2, 60);
}

static void fit_path(void) {
    const int row = ROUGHNESSES / 2, column = VIEWS * 5 / 8;
    static const double first[PARAMETERS] = { -0.7, -1.3, 0.14, 0.03, 0.7,  -1,
                                              0.3,  0.01, 3.4,  1.1,  0.35, 0.002 };
    memcpy(nodes[row][column].fit, first, sizeof first);
    node_fit(&nodes[row][column], nodes[row][column].fit, first, 1e-3, 200);
    for (int r = row + 1; r < ROUGHNESSES; r++)
        fit_from(r, column, r - 1, column);
    for (int r = row - 1; r >= 0; r--)
        fit_from(r, column, r + 1, column);
#pragma omp parallel for schedule(dynamic)
    for (int r = 0; r < ROUGHNESSES; r++) {
        for (int c = column - 1; c >= 0; c--)
            fit_from(r, c, r, c + 1);
        for (int c = column + 1; c < VIEWS; c++)
            fit_from(r, c, r, c - 1);
    }
}

/* Fits a node again, from where it is and from where its neighbors are; the best stays. */
static void refit(int row, int column, double pull, bool jump) {
    static const int around[4][2] = { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
    const double *starts[5] = { nodes[row][column].fit };
    double toward[PARAMETERS] = { 0 };
    int count = 1;
    for (int i = 0; i < 4; i++) {
        const int r = row + around[i][0], c = column + around[i][1];
        if (r < 0 || r >= ROUGHNESSES || c < 0 || c >= VIEWS)
            continue;
        starts[count++] = nodes[r][c].fit;
    }
    for (int i = 1; i < count; i++)
        for (int k = 0; k < PARAMETERS; k++)
            toward[k] += starts[i][k] / (count - 1);
    double best[PARAMETERS], best_error = HUGE_VAL;
    for (int i = 0; i < (jump ? count : 1); i++) {
        double p[PARAMETERS];
        memcpy(p, starts[i], sizeof p);
        const double error = node_fit(&nodes[row][column], p, toward, pull, 12);
        if (error < best_error) {
            best_error = error;
            memcpy(best, p, sizeof p);
        }
    }
    memcpy(nodes[row][column].fit, best, sizeof best);
}

static void report(const char *when) {
    double worst = 0, sum = 0;
    int row = 0, column = 0;
    for (int i = 0; i < ROUGHNESSES * VIEWS; i++) {
        const double error = node_error(&nodes[i / VIEWS][i % VIEWS]);
        sum += error * error;
        if (error > worst) {
            worst = error;
            row = i / VIEWS;
            column = i % VIEWS;
        }
    }
    fprintf(stderr, "%-6s rms %.4f, worst node %.4f (row %d, column %d)\n", when,
            sqrt(sum / (ROUGHNESSES * VIEWS)), worst, row, column);
}

/* --- output ----------------------------------------------------------------------------------- */

static void print_table(void) {
    printf("/* SPDX-License-Identifier: MIT */\n"
           "/* clang-format off */\n"
           "/* Written by generate/ggx.c: do not edit. */\n"
           "#include \"src/lobe/ggx_table.h\"\n\n"
           "const float lmp_ggx_table[LMP_GGX_ROUGHNESSES][LMP_GGX_VIEWS][LMP_GGX_LOBES][4] = {\n");
    for (int row = 0; row < ROUGHNESSES; row++) {
        printf("  { /* alpha %.4f */\n", node_alpha(row));
        for (int column = 0; column < VIEWS; column++) {
            printf("    {");
            for (int k = 0; k < LOBES; k++) {
                const double *p = nodes[row][column].fit + 4 * k;
                printf(" { %.4ff, %#.5gf, %.5ff, %.5ff },", p[0], exp(p[1]), p[2], p[3]);
            }
            printf(" },\n");
        }
        printf("  },\n");
    }
    printf("};\n\nconst float lmp_ggx_diffuse[LMP_GGX_VIEWS] = {\n");
    for (int column = 0; column < VIEWS; column++)
        printf("  %.7ff,\n", caps_diffuse(node_z(column)));
    printf("};\n");
}

int main(void) {
    caps_start();
#pragma omp parallel for schedule(dynamic)
    for (int row = 0; row < ROUGHNESSES; row++) {
        for (int size = 0; size <= SIZES; size++)
            caps_table_fill(&tables[row][size], node_alpha(row),
                            node_cap_size(node_alpha(row), size));
        for (int column = 0; column < VIEWS; column++)
            node_create(&nodes[row][column], node_z(column), node_alpha(row), tables[row]);
    }
    fprintf(stderr, "targets done\n");
    fit_path();
    report("path");
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        const double pull = 0.1 * pow(0.05, (double)sweep / (SWEEPS - 1));
        for (int color = 0; color < 2; color++) {
#pragma omp parallel for schedule(dynamic)
            for (int i = 0; i < ROUGHNESSES * VIEWS; i++)
                if ((i / VIEWS + i % VIEWS) % 2 == color)
                    refit(i / VIEWS, i % VIEWS, pull, sweep < SWEEPS / 2);
        }
        report("sweep");
    }
    print_table();
    return EXIT_SUCCESS;
}
