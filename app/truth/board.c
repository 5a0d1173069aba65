/* SPDX-License-Identifier: MIT */
#include "app/truth/board.h"
#include "app/base/choice.h"
#include "app/base/progress.h"
#include "app/base/timing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RUNS    9    /* of which the fastest counts */
#define SECONDS 2e-3 /* per run, at least */

/* --- cells ------------------------------------------------------------------------------------ */

board_cell board_all(const board_score *score) {
    board_cell cell = { .by = score->by };
    for (int k = 0; k < RULER_GROUPINGS; k++)
        cell.group[k] = -1;
    return cell;
}

static bool in_cell(const ruler_row *row, const void *user) {
    const board_cell *const cell = user;
    for (int k = 0; k < RULER_GROUPINGS; k++)
        if (cell->group[k] >= 0 && !ruler_in_group(&ruler_groupings[k], cell->group[k], row))
            return false;
    return formula_applies(cell->by, row);
}

ruler_figures board_figures(const board *b, const board_score *score, const board_cell *cell) {
    return ruler_figures_of(b->table, score->values, in_cell, cell);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double board_median(const board *b, const board_score *score, const board_cell *cell) {
    size_t count = 0;
    for (int i = 0; i < b->table->count; i++)
        if (in_cell(&b->table->rows[i], cell))
            b->errors[count++] = fabs(ruler_error(&b->table->rows[i], score->values[i]));
    qsort(b->errors, count, sizeof *b->errors, compare);
    return count ? (b->errors[(count - 1) / 2] + b->errors[count / 2]) / 2 : 0;
}

const ruler_row *board_worst(const board *b, const board_score *score, const board_cell *cell) {
    const ruler_row *worst = NULL;
    double largest = -1;
    for (int i = 0; i < b->table->count; i++) {
        const ruler_row *const row = &b->table->rows[i];
        const double error = fabs(ruler_error(row, score->values[i]));
        if (!in_cell(row, cell) || error <= largest)
            continue;
        worst = row;
        largest = error;
    }
    return worst;
}

/* --- judging ---------------------------------------------------------------------------------- */

/* Returns the nanoseconds per query of the fastest of several runs, in which all queries are
 * repeated as often as the clock requires. */
static double time_of(const formula *by, const formula_reads *reads, const formula_query *queries,
                      int count) {
    double fastest = (double)INFINITY;
    volatile float sink = 0;
    for (int run = 0; run < RUNS; run++) {
        const double start = timing_now();
        double seconds = 0;
        int rounds = 0;
        for (; seconds < SECONDS; rounds++) {
            for (int i = 0; i < count; i++)
                sink = by->radiance(&queries[i], reads);
            seconds = timing_now() - start;
        }
        fastest = fmin(fastest, seconds / rounds / count);
    }
    (void)sink;
    return fastest * 1e9;
}

static void judge(const board *b, board_score *score, const formula_reads *reads,
                  formula_query *queries) {
    for (int m = 0; m < RULER_MATERIALS; m++) {
        int count = 0;
        for (int i = 0; i < b->table->count; i++) {
            const ruler_row *const row = &b->table->rows[i];
            if (row->material != (ruler_material)m || !formula_applies(score->by, row))
                continue;
            queries[count] = formula_query_of(row);
            score->values[i] = (double)score->by->radiance(&queries[count++], reads);
        }
        if (count > 0)
            score->nanoseconds[m] = time_of(score->by, reads, queries, count);
    }
}

static bool add(board *b, const formula *by, base_error *error) {
    board_score *const score = &b->scores[b->count];
    formula_reads reads;
    if (!formula_open(by, b->published, &reads, error))
        return false;
    formula_query *const queries = malloc(((size_t)b->table->count + 1) * sizeof *queries);
    *score = (board_score) { .by = by };
    score->values = calloc((size_t)b->table->count + 1, sizeof *score->values);
    const bool made = queries && score->values;
    if (made)
        judge(b, score, &reads, queries);
    b->count++;
    free(queries);
    formula_close(&reads);
    return made || base_fail(error, NULL, "out of memory");
}

/* Whether a formula is named; without names, all are chosen except those that need a published
 * table that is missing. */
static bool is_chosen(const board *b, const cli_list *names, const formula *by) {
    for (int i = 0; i < names->count; i++)
        if (strcmp(names->items[i], by->name) == 0)
            return true;
    return names->count == 0 && (!by->published || b->published);
}

static bool check_names(const cli_list *names, base_error *error) {
    const char *known[FORMULAS_MAX + 1];
    choice_names(&formula_table[0].name, sizeof *formula_table, formula_count, known);
    for (int i = 0; i < names->count; i++) {
        int k = 0;
        while (k < formula_count && strcmp(known[k], names->items[i]) != 0)
            k++;
        if (k == formula_count)
            return choice_fail(error, "formula", names->items[i], known);
    }
    return true;
}

bool board_create(const ruler_table *table, const cli_list *names, const cosines_table *published,
                  board *result, base_error *error) {
    *result = (board) { .table = table, .published = published };
    if (!check_names(names, error))
        return false;
    result->scores = calloc((size_t)formula_count, sizeof *result->scores);
    result->errors = malloc(((size_t)table->count + 1) * sizeof *result->errors);
    if (!result->scores || !result->errors) {
        board_free(result);
        return base_fail(error, NULL, "out of memory");
    }
    for (int k = 0; k < formula_count; k++) {
        progress_show("judging", (double)k / formula_count);
        if (is_chosen(result, names, &formula_table[k]) && !add(result, &formula_table[k], error)) {
            board_free(result);
            return false;
        }
    }
    progress_end();
    return true;
}

void board_free(board *b) {
    for (int k = 0; k < b->count; k++)
        free(b->scores[k].values);
    free(b->scores);
    free(b->errors);
    *b = (board) { .count = 0 };
}
