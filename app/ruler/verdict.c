/* SPDX-License-Identifier: MIT */
#include "app/ruler/verdict.h"
#include "app/ruler/mistake.h"

#include <math.h>
#include <stdio.h>

#define WORST 8 /* rows that are named */

/* --- groups ----------------------------------------------------------------------------------- */

static double material_of(const ruler_row *row) {
    return row->material;
}
static double light_of(const ruler_row *row) {
    return row->light;
}
static double roughness_of(const ruler_row *row) {
    return row->material >= RULER_METAL ? row->roughness : (double)NAN;
}
static double exponent_of(const ruler_row *row) {
    return row->material == RULER_PHONG ? row->exponent : (double)NAN;
}
static double distance_of(const ruler_row *row) {
    return row->light == RULER_SPHERE ? 1 / row->size : (double)NAN;
}
static double view_of(const ruler_row *row) {
    return row->view_angle;
}

/* Rows from `low` on and below `high` by one of their numbers. */
typedef struct group {
    double (*of)(const ruler_row *row);
    double low, high;
} group;

static bool in_group(const ruler_row *row, const void *user) {
    const group *const g = user;
    const double number = g->of(row);
    return number >= g->low && number < g->high;
}

/* What rows are grouped by, and where each group begins; named ones are numbered from 0. */
typedef struct grouping {
    const char *name;
    double (*of)(const ruler_row *row);
    int count;
    double from[8];
    const char *const *names;
} grouping;
static const grouping groupings[] = {
    { "material", material_of, RULER_MATERIALS, { 0, 1, 2, 3 }, ruler_material_names },
    { "exponent", exponent_of, 4, { 1, 10, 100, 1000 }, NULL },
    { "roughness", roughness_of, 7, { 0.17, 0.22, 0.3, 0.4, 0.6, 0.8, 1 }, NULL },
    { "light", light_of, RULER_LIGHTS, { 0, 1, 2, 3, 4 }, ruler_light_names },
    { "half angle, degrees", ruler_half_angle, 6, { 0, 0.01, 1, 10, 40, 90 }, NULL },
    { "distance, radii", distance_of, 6, { 0, 1, 1.2, 2, 10, 100 }, NULL },
    { "view angle, degrees", view_of, 5, { 0, 30, 60, 75, 85 }, NULL },
};

static void print_figures(const char *name, const ruler_figures *f) {
    printf("  %-22s %5d  %9.3g  %9.3g  %8.4f\n", name, f->count, f->rms, f->largest, f->energy);
}

static void print_grouping(const ruler_table *table, const double *values, const grouping *by) {
    bool titled = false;
    for (int k = 0; k < by->count; k++) {
        const group g = { by->of, by->from[k],
                          k + 1 < by->count ? by->from[k + 1] : (double)INFINITY };
        const ruler_figures f = ruler_figures_of(table, values, in_group, &g);
        char name[32];
        if (f.count == 0)
            continue;
        if (!titled)
            printf("by %s\n", by->name);
        titled = true;
        if (by->names)
            snprintf(name, sizeof name, "%s", by->names[k]);
        else if (isinf(g.high))
            snprintf(name, sizeof name, "from %g", g.low);
        else
            snprintf(name, sizeof name, "%g to %g", g.low, g.high);
        print_figures(name, &f);
    }
}

/* --- the worst -------------------------------------------------------------------------------- */

static void print_worst(const ruler_table *table, const double *values) {
    int worst[WORST + 1], count = 0;
    for (int i = 0; i < table->count; i++) {
        const double error = fabs(ruler_error(&table->rows[i], values[i]));
        int k = count;
        for (; k > 0 && fabs(ruler_error(&table->rows[worst[k - 1]], values[worst[k - 1]])) < error;
             k--)
            worst[k] = worst[k - 1];
        worst[k] = i;
        if (error > 0 && count < WORST)
            count++;
    }
    if (count > 0)
        printf("worst rows: %s,value -> yours (error)\n", ruler_table_header());
    for (int k = 0; k < count; k++) {
        const ruler_row *const row = &table->rows[worst[k]];
        printf("  %.*s,%.9g -> %.9g (%+.3g)\n", row->length, row->text, row->value,
               values[worst[k]], ruler_error(row, values[worst[k]]));
    }
}

bool ruler_verdict(const ruler_table *table, const double *values, const ruler_limits *limits) {
    const ruler_figures all = ruler_figures_of(table, values, NULL, NULL);
    printf("%-24s %5s  %9s  %9s  %8s\n", "errors", "rows", "rms", "max", "energy");
    print_figures("all", &all);
    for (size_t k = 0; k < sizeof groupings / sizeof *groupings; k++)
        print_grouping(table, values, &groupings[k]);
    print_worst(table, values);
    const bool within = all.rms <= limits->rms && all.largest <= limits->largest;
    if (!within)
        ruler_mistake_print(table, values, limits);
    printf("verdict: %s (rms %.3g of at most %g, max %.3g of at most %g)\n",
           within ? "within the limits" : "beyond the limits", all.rms, limits->rms, all.largest,
           limits->largest);
    return within;
}
