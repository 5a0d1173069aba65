/* SPDX-License-Identifier: MIT */
/* Writes src/lobe/ggx_table.c to standard output, and how well it fits to standard error; takes a
 * minute and a half of one core.
 *
 * A node of the table, a view angle and a roughness, is a least-squares fit of Phong lobes to what
 * caps of three sizes and a whole sky reflect by glTF's GGX. The sizes follow the width of the
 * lobe, so that mirrors are fitted as closely as chalk. Errors of some hundredths of a peak count
 * by their fourth power, those of rough metals by their sixth, and what all caps of a size reflect
 * together counts besides. Nodes are first fitted along a path, each from its neighbor's result,
 * then again under a pull to the mean of their neighbors, which falls from sweep to sweep: lobes
 * keep their identity, and the table can be interpolated. */
#include "src/lobe/generate/node.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { VIEWS = LMP_GGX_VIEWS, ROUGHNESSES = LMP_GGX_ROUGHNESSES, SWEEPS = 12 };

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

/* The column from which a row's lobes from LMP_GGX_LOBES_FEW on have weight 0: smooth surfaces need
 * them from about 55 degrees on, rough ones from 65. */
static int few_column(int row) {
    return row < 15 ? 24 : row < 18 ? 38 - row : 20;
}

/* They fade towards it. */
static double extra_max(int row, int column) {
    return fmax(0, fmin(3, 0.12 * (few_column(row) - column)));
}

static void fit_from(int row, int column, int row_from, int column_from) {
    fit_node *to = &nodes[row][column];
    double toward[PARAMETERS];
    memcpy(toward, nodes[row_from][column_from].fit, sizeof toward);
    memcpy(to->fit, toward, sizeof toward);
    node_fit(to, to->fit, toward, 0.1, 60);
}

static void fit_path(void) {
    const int row = 12, column = 13;
    static const double first[PARAMETERS] = { -0.33, -2.81, 0.11, 0.035, 1.39, -1.63, 0.21,
                                              0.07,  14.5,  2.86, 0.17,  0.05, 0.40,  -2.66,
                                              0.15,  0.05,  3.33, 0,     0.22, 0.07 };
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

/* Fits a node again, pulled to the mean of its neighbors. It starts from where it is: from a
 * neighbor's fit it might come to other lobes, and the table would have a seam. */
static void refit(int row, int column, double pull) {
    static const int around[4][2] = { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
    double toward[PARAMETERS] = { 0 };
    int count = 0;
    for (int i = 0; i < 4; i++) {
        const int r = row + around[i][0], c = column + around[i][1];
        if (r < 0 || r >= ROUGHNESSES || c < 0 || c >= VIEWS)
            continue;
        for (int k = 0; k < PARAMETERS; k++)
            toward[k] += nodes[r][c].fit[k];
        count++;
    }
    for (int k = 0; k < PARAMETERS; k++)
        toward[k] /= count;
    node_fit(&nodes[row][column], nodes[row][column].fit, toward, pull, 12);
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
    printf("};\n\nconst float lmp_ggx_few[LMP_GGX_ROUGHNESSES] = {\n");
    for (int row = 0; row < ROUGHNESSES; row++)
        printf("  %d,\n", few_column(row));
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
            node_create(&nodes[row][column], node_z(column), node_alpha(row),
                        extra_max(row, column), tables[row]);
    }
    fprintf(stderr, "targets done\n");
    fit_path();
    report("path");
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        const double pull = 0.1 * pow(0.02, (double)sweep / (SWEEPS - 1));
        for (int color = 0; color < 2; color++) {
#pragma omp parallel for schedule(dynamic)
            for (int i = 0; i < ROUGHNESSES * VIEWS; i++)
                if ((i / VIEWS + i % VIEWS) % 2 == color)
                    refit(i / VIEWS, i % VIEWS, pull);
        }
        report("sweep");
    }
    print_table();
    return EXIT_SUCCESS;
}
