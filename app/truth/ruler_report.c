/* SPDX-License-Identifier: MIT */
#include "app/truth/ruler_report.h"
#include "app/truth/ruler_diagnosis.h"
#include "app/truth/ruler_group.h"

#include <math.h>
#include <stdio.h>

#define WORST 8 /* rows that are listed */

/* --- groups ----------------------------------------------------------------------------------- */

typedef struct group {
    const ruler_grouping *by;
    int index;
} group;

static bool in_group(const ruler_row *row, const void *user) {
    const group *const g = user;
    return ruler_in_group(g->by, g->index, row);
}

static void print_figures(const char *name, const ruler_figures *f) {
    printf("  %-22s %5d  %9.3g  %9.3g  %8.4f\n", name, f->count, f->rms, f->largest, f->energy);
}

static void print_grouping(const ruler_table *table, const double *values,
                           const ruler_grouping *by) {
    bool titled = false;
    for (int k = 0; k < by->count; k++) {
        const group g = { by, k };
        const ruler_figures f = ruler_figures_of(table, values, in_group, &g);
        char name[32];
        if (f.count == 0)
            continue;
        if (!titled)
            printf("by %s\n", by->name);
        titled = true;
        ruler_group_name(by, k, name, sizeof name);
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

bool ruler_report(const ruler_table *table, const double *values, const ruler_limits *limits) {
    const ruler_figures all = ruler_figures_of(table, values, NULL, NULL);
    printf("%-24s %5s  %9s  %9s  %8s\n", "errors", "rows", "rms", "max", "energy");
    print_figures("all", &all);
    for (int k = 0; k < RULER_GROUPINGS; k++)
        print_grouping(table, values, &ruler_groupings[k]);
    print_worst(table, values);
    const bool within = all.rms <= limits->rms && all.largest <= limits->largest;
    if (!within)
        ruler_diagnosis_print(table, values, limits);
    printf("verdict: %s (rms %.3g of at most %g, max %.3g of at most %g)\n",
           within ? "within the limits" : "beyond the limits", all.rms, limits->rms, all.largest,
           limits->largest);
    return within;
}
