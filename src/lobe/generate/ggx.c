/* SPDX-License-Identifier: MIT */
/* Writes src/lobe/ggx_table.c to standard output, and how well it fits to standard error; takes
 * three and a half minutes of one core.
 *
 * A node of the table, a view angle and a roughness, is a least-squares fit of Phong lobes to what
 * caps of four sizes and a whole sky reflect by glTF's GGX. The sizes follow the width of the lobe,
 * so that mirrors are fitted as closely as chalk. Errors of some hundredths of a peak count by
 * their fourth power, and what all caps of a size reflect together counts besides.
 *
 * Nodes are first fitted along a path, each from its neighbor's result, and with no weight below 0;
 * then rough ones get lobes of negative weight; then all are fitted in sweeps, each to what it and
 * the means of it and its neighbors should follow, which is what is looked up between nodes. A pull
 * to the mean of the neighbors falls from sweep to sweep. */
#include "src/lobe/generate/fit.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    VIEWS = LMPI_GGX_VIEWS,
    ROUGHNESSES = LMPI_GGX_ROUGHNESSES,
    FINE_VIEWS = 2 * VIEWS - 1, /* with the nodes halfway between */
    FINE_ROUGHNESSES = 2 * ROUGHNESSES - 1
};

static const double pi = 3.14159265358979323846;

static fit_node nodes[FINE_ROUGHNESSES][FINE_VIEWS];
static caps_table tables[FINE_ROUGHNESSES][SIZES + 1];
static double fits[ROUGHNESSES][VIEWS][PARAMETERS];

static double fine_alpha(int row) {
    const double least = (double)LMPI_GGX_ROUGHNESS_MIN;
    const double roughness = least + (1 - least) * row / (FINE_ROUGHNESSES - 1);
    return roughness * roughness;
}

/* Returns the cosine of a column's view; the last column is normal incidence. */
static double fine_z(int column) {
    const double root = (double)column / (FINE_VIEWS - 1);
    return root * root;
}

static void create_nodes(void) {
#pragma omp parallel for schedule(dynamic)
    for (int row = 0; row < FINE_ROUGHNESSES; row++) {
        const double alpha = fine_alpha(row);
        for (int size = 0; size <= SIZES; size++)
            caps_table_fill(&tables[row][size], alpha, node_cap_size(alpha, size));
        for (int column = 0; column < FINE_VIEWS; column++)
            node_create(&nodes[row][column], fine_z(column), alpha, tables[row]);
    }
}

/* --- what lobes may be ------------------------------------------------------------------------ */

/* Rises from 0 at `from` to 1 at `until`. */
static double ramp(double x, double from, double until) {
    return fmin(fmax((x - from) / (until - from), 0), 1);
}

/* Returns the column from which a row's lobes from LMP_GGX_LOBES_FEW on have weight 0: smooth
 * surfaces need them from 53 degrees on, rough ones from 41. */
static int few_column(int row) {
    return row < 17 ? 24 : row < 20 ? row + 7 : 27;
}

/* Returns the largest weight of the extra lobes, which fade toward that column. */
static double extra_max(int row, int column) {
    return fmax(0, fmin(3, 0.12 * (few_column(row) - column)));
}

/* GGX of roughness 1 is z/(z + c) around the normal, a wide lobe less a narrower one; and two
 * lobes of opposite signs end a reflection toward the horizon. The lobes that become negative are
 * those that rough materials have no other use for: lobe 0, which is near the horizon at columns
 * below HORIZON and around the normal from there on, and at grazing views lobe 1, around the
 * normal. */
enum {
    HORIZON = 17,
    SHARED = 22,
    AROUND_NORMAL = 24,
    AROUND_NORMAL_GRAZING = 28,
    NEAR_HORIZON = 20
};
#define NEGATIVE_MOST 2.5

static double least_weight(int row, int column, int lobe) {
    if (lobe > 1)
        return 0;
    if (lobe == 1)
        return -NEGATIVE_MOST * ramp(row, AROUND_NORMAL_GRAZING, AROUND_NORMAL_GRAZING + 2) *
               ramp(-column, -SHARED - 2, -SHARED + 1);
    const double around = NEGATIVE_MOST * ramp(row, AROUND_NORMAL, 30);
    const double near = ramp(row, NEAR_HORIZON - 1, NEAR_HORIZON + 2);
    return column > HORIZON ? -around : -fmax(around, near);
}

static void problem_create(fit_problem *problem, int row, int column, bool negative, double pull) {
    static const double least[4] = { -10, CAPS_SPREAD_LOG_MIN + 0.3, 0, 0 };
    const double alpha = fine_alpha(2 * row), exponent_min = 0.02;
    const double most[4] = { 80,
                             fmin(CAPS_SPREAD_LOG_MAX - 0.3, -log(exponent_min * alpha * alpha)), 3,
                             3 };
    *problem = (fit_problem) { .terms = { { .node = &nodes[2 * row][2 * column], .weight = 1 } },
                               .count = 1,
                               .pull = pull };
    for (int i = 0; i < PARAMETERS; i++) {
        const bool weight = i % 4 >= 2;
        problem->least[i] = weight && negative ? least_weight(row, column, i / 4) : least[i % 4];
        problem->most[i] =
            weight && i / 4 >= LMP_GGX_LOBES_FEW ? extra_max(row, column) : most[i % 4];
    }
}

/* --- the path --------------------------------------------------------------------------------- */

static void fit_from(int row, int column, int row_from, int column_from) {
    fit_problem problem;
    problem_create(&problem, row, column, false, 0.1);
    memcpy(problem.toward, fits[row_from][column_from], sizeof problem.toward);
    memcpy(fits[row][column], problem.toward, sizeof problem.toward);
    fit_improve(&problem, fits[row][column], 60);
}

static void fit_path(void) {
    const int row = 12, column = 13;
    static const double first[PARAMETERS] = { -0.33, -2.81, 0.11, 0.035, 1.39, -1.63, 0.21,
                                              0.07,  14.5,  2.86, 0.17,  0.05, 0.40,  -2.66,
                                              0.15,  0.05,  3.33, 0,     0.22, 0.07 };
    fit_problem problem;
    problem_create(&problem, row, column, false, 1e-3);
    memcpy(problem.toward, first, sizeof first);
    memcpy(fits[row][column], first, sizeof first);
    fit_improve(&problem, fits[row][column], 200);
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

/* --- lobes of negative weight ----------------------------------------------------------------- */

static void put(double lobe[4], double height, double spread_log, double f0, double f90) {
    lobe[0] = height;
    lobe[1] = spread_log;
    lobe[2] = f0;
    lobe[3] = f90;
}

/* Starts lobe k around the normal, with part of its weight taken from the wide lobe. */
static void start_around_normal(double p[PARAMETERS], int k, int row) {
    const double alpha = fine_alpha(2 * row), weight = 0.4 * ramp(row, AROUND_NORMAL, 31);
    put(p + 4 * k, 60, -log(1.3 * alpha * alpha), -weight, 0);
    p[4 * 2 + 1] -= 0.2;
    p[4 * 2 + 2] += 1.1 * weight;
}

/* Starts lobes at grazing views: 0 and 3 lie near the horizon; lobe 1, 14 degrees from the mirror
 * direction toward the normal, vanishes before it becomes the one around the normal. */
static void start_near_horizon(double p[PARAMETERS], int row, int column) {
    const double alpha = fine_alpha(2 * row), z = fine_z(2 * column), toward = 14 * pi / 180;
    const double fade = ramp(-column, -HORIZON, -HORIZON + 3);
    const double weight = 0.1 * ramp(row, NEAR_HORIZON, NEAR_HORIZON + 3) * fade;
    put(p, -0.095, -3.38, -weight, -0.4 * weight);
    put(p + 12, -0.07, -3.47, 1.05 * weight, 0.45 * weight);
    if (row > AROUND_NORMAL_GRAZING) {
        start_around_normal(p, 1, row);
    } else if (row > AROUND_NORMAL) {
        const double left =
            fade * 0.05 * ramp(-row, -AROUND_NORMAL_GRAZING - 1, -AROUND_NORMAL - 1);
        put(p + 4, (sqrt(1 - z * z) / tan(acos(z) - toward) - z) / alpha, -log(14 * alpha * alpha),
            left, 0.3 * left);
    }
}

static void start_negative(int row, int column) {
    double *p = fits[row][column];
    if (column >= HORIZON && row <= AROUND_NORMAL)
        return;
    if (column < HORIZON) {
        start_near_horizon(p, row, column);
    } else {
        start_around_normal(p, 0, row);
        if (row > AROUND_NORMAL_GRAZING && column < SHARED) {
            const double part = ramp(-column, -SHARED, -HORIZON);
            put(p + 4, p[0], p[1], part * p[2], 0);
            p[2] *= 1 - part;
        }
    }
    fit_problem problem;
    problem_create(&problem, row, column, true, 0.01);
    memcpy(problem.toward, p, sizeof problem.toward);
    fit_improve(&problem, p, 40);
}

static void start_all_negative(void) {
#pragma omp parallel for schedule(dynamic)
    for (int column = 0; column < VIEWS; column++)
        for (int row = NEAR_HORIZON + 1; row < ROUGHNESSES; row++)
            start_negative(row, column);
}

/* --- sweeps ----------------------------------------------------------------------------------- */

/* Adds the nodes halfway to the neighbors, also to those across. */
static void add_neighbors(fit_problem *problem, int row, int column) {
    int count = 0;
    for (int i = 0; i < 9; i++) {
        const int down = i / 3 - 1, right = i % 3 - 1, r = row + down, c = column + right;
        if (i == 4 || r < 0 || r >= ROUGHNESSES || c < 0 || c >= VIEWS)
            continue;
        const bool across = down != 0 && right != 0;
        fit_term *term = &problem->terms[problem->count++];
        *term = (fit_term) { &nodes[2 * row + down][2 * column + right],
                             { fits[r][c], fits[row][c], fits[r][column] },
                             across ? 3 : 1,
                             across ? 0.5 : 1 };
        if (across)
            continue;
        for (int k = 0; k < PARAMETERS; k++)
            problem->toward[k] += fits[r][c][k];
        count++;
    }
    for (int k = 0; k < PARAMETERS; k++)
        problem->toward[k] /= count;
}

/* Sweeps the nodes by color: nodes of one color are no neighbors. */
static void sweep(int first_row, bool negative, double pull, int steps) {
    for (int color = 0; color < 4; color++) {
#pragma omp parallel for schedule(dynamic)
        for (int i = first_row * VIEWS; i < ROUGHNESSES * VIEWS; i++) {
            const int row = i / VIEWS, column = i % VIEWS;
            if (row % 2 * 2 + column % 2 != color)
                continue;
            fit_problem problem;
            problem_create(&problem, row, column, negative, pull);
            add_neighbors(&problem, row, column);
            fit_improve(&problem, fits[row][column], steps);
        }
    }
}

/* Reports the errors of the nodes, and of the points halfway between two nodes, and four. */
static void report(const char *when) {
    double worst[3] = { 0 }, sum[3] = { 0 };
    int at[3] = { 0 }, count[3] = { 0 };
    for (int i = 0; i < FINE_ROUGHNESSES * FINE_VIEWS; i++) {
        const int row = i / FINE_VIEWS, column = i % FINE_VIEWS, kind = row % 2 + column % 2;
        const int r = row / 2, c = column / 2, below = (row + 1) / 2, right = (column + 1) / 2;
        const double *const near[4] = { fits[r][c], fits[r][right], fits[below][c],
                                        fits[below][right] };
        double mean[PARAMETERS], chain[PARAMETERS];
        fit_mean(near, 4, mean, chain);
        const double error = node_error(&nodes[row][column], mean);
        sum[kind] += error * error;
        count[kind]++;
        if (error > worst[kind]) {
            worst[kind] = error;
            at[kind] = i;
        }
    }
    fprintf(stderr, "%-6s", when);
    for (int k = 0; k < 3; k++)
        fprintf(stderr, " rms %.4f, worst %.4f (row %.1f, column %.1f)", sqrt(sum[k] / count[k]),
                worst[k], at[k] / FINE_VIEWS / 2., at[k] % FINE_VIEWS / 2.);
    fprintf(stderr, "\n");
}

static void fit_all(void) {
    enum { SMOOTH = 3, ROUGH = 6, FIRST_ROUGH = 18 };
    fit_path();
    report("path");
    for (int i = 0; i < SMOOTH; i++)
        sweep(0, false, 0.1 * pow(0.4, i), 3);
    report("smooth");
    start_all_negative();
    for (int i = 0; i < ROUGH; i++)
        sweep(FIRST_ROUGH, true, 0.1 * pow(0.02, (double)i / (ROUGH - 1)), 4);
    report("rough");
    sweep(0, true, 0.002, 4);
    report("all");
}

/* --- output ----------------------------------------------------------------------------------- */

static void print_table(void) {
    printf(
        "/* SPDX-License-Identifier: MIT */\n"
        "/* clang-format off */\n"
        "/* Written by generate/ggx.c: do not edit. */\n"
        "#include \"src/lobe/ggx_table.h\"\n\n"
        "const float lmpi_ggx_table[LMPI_GGX_ROUGHNESSES][LMPI_GGX_VIEWS][LMP_GGX_LOBES][4] = {\n");
    for (int row = 0; row < ROUGHNESSES; row++) {
        printf("  { /* alpha %.4f */\n", fine_alpha(2 * row));
        for (int column = 0; column < VIEWS; column++) {
            printf("    {");
            for (int k = 0; k < LOBES; k++) {
                const double *p = fits[row][column] + 4 * k;
                printf(" { %.4ff, %#.5gf, %.5ff, %.5ff },", p[0], exp(p[1]), p[2], p[3]);
            }
            printf(" },\n");
        }
        printf("  },\n");
    }
    printf("};\n\nconst float lmpi_ggx_few[LMPI_GGX_ROUGHNESSES] = {\n");
    for (int row = 0; row < ROUGHNESSES; row++)
        printf("  %d,\n", few_column(row));
    printf("};\n\nconst float lmpi_ggx_diffuse[LMPI_GGX_VIEWS] = {\n");
    for (int column = 0; column < VIEWS; column++)
        printf("  %.7ff,\n", caps_diffuse(fine_z(2 * column)));
    printf("};\n");
}

int main(void) {
    caps_start();
    create_nodes();
    fprintf(stderr, "targets done\n");
    fit_all();
    print_table();
    return EXIT_SUCCESS;
}
