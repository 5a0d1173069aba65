/* SPDX-License-Identifier: MIT */
#include "app/truth/scoreboard_print.h"

#include <stdio.h>

/* --- text ------------------------------------------------------------------------------------- */

static void print_material(const board *b, int material) {
    for (int k = 0, titled = 0; k < b->count; k++) {
        const board_score *const score = &b->scores[k];
        board_cell cell = board_all(score);
        cell.group[RULER_BY_MATERIAL] = material;
        const ruler_figures f = board_figures(b, score, &cell);
        if (f.count == 0)
            continue;
        if (!titled++)
            printf("%s, %d rows\n  %-15s %9s %9s %9s %9s %9s %9s  %s\n",
                   ruler_material_names[material], f.count, "formula", "rms", "balanced", "median",
                   "max", "energy", "ns", "worst row");
        printf("  %-15s %9.3g %9.3g %9.3g %9.3g %9.4f %9.1f  %d\n", score->by->name, f.rms,
               f.balanced, board_median(b, score, &cell), f.largest, f.energy,
               score->nanoseconds[material], board_worst(b, score, &cell)->id);
    }
}

/* Prints the root mean square of the balanced errors of metals, by groups. */
static void print_grouping(const board *b, int grouping) {
    const ruler_grouping *const by = &ruler_groupings[grouping];
    printf("balanced rms of %s by %s\n  %-15s", ruler_material_names[RULER_METAL], by->name,
           "formula");
    for (int g = 0; g < by->count; g++) {
        char name[32];
        ruler_group_name(by, g, name, sizeof name);
        printf(" %12s", name);
    }
    putchar('\n');
    for (int k = 0; k < b->count; k++) {
        board_cell cell = board_all(&b->scores[k]);
        cell.group[RULER_BY_MATERIAL] = RULER_METAL;
        if (!cell.by->applies[RULER_METAL])
            continue;
        printf("  %-15s", cell.by->name);
        for (int g = 0; g < by->count; g++) {
            cell.group[grouping] = g;
            const ruler_figures f = board_figures(b, &b->scores[k], &cell);
            if (f.count)
                printf(" %12.3g", f.balanced);
            else
                printf(" %12s", "-");
        }
        putchar('\n');
    }
}

void board_print_text(const board *b) {
    for (int m = 0; m < RULER_MATERIALS; m++)
        print_material(b, m);
    print_grouping(b, RULER_BY_ROUGHNESS);
    print_grouping(b, RULER_BY_ANGLE);
    print_grouping(b, RULER_BY_VIEW);
}

/* --- records ---------------------------------------------------------------------------------- */

typedef void record_printer(const board *b, const board_score *score, const board_cell *cell,
                            const ruler_figures *f, bool first);

static const int columns[] = { RULER_BY_ROUGHNESS, RULER_BY_ANGLE, RULER_BY_VIEW };
enum { COLUMNS = sizeof columns / sizeof *columns };

/* Prints all groups of a column and of those after it, or skips the column if the material has no
 * groups in it. Returns whether there was a row. */
static bool visit(const board *b, const board_score *score, board_cell *cell, int column,
                  record_printer *print) {
    if (column == COLUMNS) {
        const ruler_figures f = board_figures(b, score, cell);
        if (f.count)
            print(b, score, cell, &f, false);
        return f.count > 0;
    }
    const int grouping = columns[column];
    bool any = false;
    for (int g = 0; g < ruler_groupings[grouping].count; g++) {
        cell->group[grouping] = g;
        any |= visit(b, score, cell, column + 1, print);
    }
    cell->group[grouping] = -1;
    return any || visit(b, score, cell, column + 1, print);
}

static void print_records(const board *b, record_printer *print) {
    bool first = true;
    for (int k = 0; k < b->count; k++)
        for (int m = 0; m < RULER_MATERIALS; m++) {
            board_cell cell = board_all(&b->scores[k]);
            cell.group[RULER_BY_MATERIAL] = m;
            const ruler_figures f = board_figures(b, &b->scores[k], &cell);
            if (!f.count)
                continue;
            print(b, &b->scores[k], &cell, &f, first);
            first = false;
            visit(b, &b->scores[k], &cell, 0, print);
        }
}

/* Returns "all", or the group's name. */
static const char *name_of(const board_cell *cell, int grouping, char name[32]) {
    snprintf(name, 32, "all");
    if (cell->group[grouping] >= 0)
        ruler_group_name(&ruler_groupings[grouping], cell->group[grouping], name, 32);
    return name;
}

static void print_line(const board *b, const board_score *score, const board_cell *cell,
                       const ruler_figures *f, bool first) {
    const int material = cell->group[RULER_BY_MATERIAL];
    char names[COLUMNS][32];
    (void)first;
    printf("%s,%s", score->by->name, ruler_material_names[material]);
    for (int c = 0; c < COLUMNS; c++)
        printf(",%s", name_of(cell, columns[c], names[c]));
    printf(",%d,%.6g,%.6g,%.6g,%.6g,%d,%.6g,%.6g\n", f->count, f->rms, f->balanced,
           board_median(b, score, cell), f->largest, board_worst(b, score, cell)->id, f->energy,
           score->nanoseconds[material]);
}

void board_print_csv(const board *b) {
    printf("formula,material,roughness,half_angle,view_angle,rows,rms,balanced,median,max,worst,"
           "energy,ns\n");
    print_records(b, print_line);
}

static void print_object(const board *b, const board_score *score, const board_cell *cell,
                         const ruler_figures *f, bool first) {
    const int material = cell->group[RULER_BY_MATERIAL];
    char names[COLUMNS][32];
    printf(
        "%s\n{ \"formula\": \"%s\", \"material\": \"%s\", \"roughness\": \"%s\", \"half_angle\": "
        "\"%s\", \"view_angle\": \"%s\", \"rows\": %d, \"rms\": %.6g, "
        "\"balanced\": %.6g, \"median\": %.6g, \"max\": %.6g, "
        "\"worst\": %d, \"energy\": %.6g, \"ns\": %.6g }",
        first ? "" : ",", score->by->name, ruler_material_names[material],
        name_of(cell, columns[0], names[0]), name_of(cell, columns[1], names[1]),
        name_of(cell, columns[2], names[2]), f->count, f->rms, f->balanced,
        board_median(b, score, cell), f->largest, board_worst(b, score, cell)->id, f->energy,
        score->nanoseconds[material]);
}

void board_print_json(const board *b) {
    printf("[");
    print_records(b, print_object);
    printf("\n]\n");
}
