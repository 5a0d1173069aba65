/* SPDX-License-Identifier: MIT */
#include "app/view/overlay.h"

#include "app/view/state.h"

#include <math.h>
#include <stdlib.h>

/* Lengths are in heights of the text. */
#define LINE       1.25
#define MARGIN     0.8
#define COLUMN_GAP 2.0
#define READABLE   0.75 /* of the interface's size of text */
enum { HELP_COLUMNS_MAX = 3, HELP_ROWS_MAX = 80 };

static double width_of(const char *text) {
    double width, height;
    ui_measure(text, 1, 0, &width, &height);
    return width;
}

/* --- rows ------------------------------------------------------------------------------------- */

view_box view_draw_rows(const view_row *rows, int count, double x, double y, double pivot,
                        ui_color paper) {
    const double em = ui_text_height(), margin = MARGIN * em;
    double names = 0, widest = 0;
    for (int i = 0; i < count; i++)
        if (rows[i].value[0])
            names = fmax(names, width_of(rows[i].name) + em);
    for (int i = 0; i < count; i++)
        widest = fmax(widest,
                      rows[i].value[0] ? names + width_of(rows[i].value) : width_of(rows[i].name));
    view_box box = { x, y, widest + 2 * margin, count * LINE * em + 2 * margin };
    box.x -= pivot * box.width;
    ui_box(box.x, box.y, box.width, box.height, 0.6 * em, paper);
    for (int i = 0; i < count; i++) {
        const double at = y + margin + (i * LINE + 0.5 * (LINE - 1)) * em;
        const bool stands_out = !rows[i].value[0] || rows[i].chosen;
        ui_write(box.x + margin, at, rows[i].name, 1, 0, stands_out ? UI_ACCENT : UI_PALE);
        ui_write(box.x + margin + names, at, rows[i].value, 1, 0, UI_INK);
    }
    return box;
}

/* --- the help --------------------------------------------------------------------------------- */

typedef struct help_layout {
    const view_key *rows[HELP_ROWS_MAX];
    int first[HELP_COLUMNS_MAX + 1]; /* the first row of each column */
    int columns;
    double keys, texts; /* widths */
} help_layout;

static int list_rows(help_layout *l) {
    int count = 0;
    for (const view_key *key = view_keys; key->key || key->shown; key++)
        if (key->shown && count < HELP_ROWS_MAX) {
            if (!view_is_heading(key)) {
                l->keys = fmax(l->keys, width_of(key->shown) + ui_text_height());
                l->texts = fmax(l->texts, width_of(key->help));
            }
            l->rows[count++] = key;
        }
    return count;
}

/* Breaks columns at headings so that the longest column is short; returns its rows. */
static int break_columns(help_layout *l, int count, int columns) {
    int longest = 0;
    l->columns = columns;
    for (int c = 1; c < columns; c++) {
        const int wanted = count * c / columns, from = l->first[c - 1];
        int best = from;
        for (int i = from + 1; i < count; i++)
            if (view_is_heading(l->rows[i]) &&
                (best == from || abs(i - wanted) < abs(best - wanted)))
                best = i;
        l->first[c] = best;
    }
    l->first[columns] = count;
    for (int c = 0; c < columns; c++)
        longest = (int)fmax(longest, l->first[c + 1] - l->first[c]);
    return longest;
}

/* Returns the box of the help in the interface's own size of text. */
static view_box help_box(const help_layout *l, int longest) {
    const double em = ui_text_height(), margin = 2 * MARGIN * em;
    return (view_box) { .width = l->columns * (l->keys + l->texts) +
                                 (l->columns - 1) * COLUMN_GAP * em + 2 * margin,
                        .height = (longest + 2) * LINE * em + 2 * margin };
}

static void write_help(const help_layout *l, const view_box *box, double size) {
    const double em = size * ui_text_height(), left = box->x + 2 * MARGIN * em;
    const double top = box->y + 2 * MARGIN * em;
    ui_write(left, top, "lampion view", size, 0, UI_INK);
    for (int c = 0; c < l->columns; c++) {
        const double x = left + c * (size * (l->keys + l->texts) + COLUMN_GAP * em);
        for (int i = l->first[c]; i < l->first[c + 1]; i++) {
            const view_key *row = l->rows[i];
            const double y = top + (i - l->first[c] + 2) * LINE * em;
            ui_write(x, y, row->shown, size, 0, view_is_heading(row) ? UI_ACCENT : UI_INK);
            if (!view_is_heading(row))
                ui_write(x + size * l->keys, y, row->help, size, 0, UI_PALE);
        }
    }
}

view_box view_draw_help(int width, int height, double *scroll) {
    help_layout l = { .columns = 0 };
    const int count = list_rows(&l);
    double size = 0;
    int best = 1;
    for (int columns = 1; columns <= HELP_COLUMNS_MAX; columns++) {
        const view_box needed = help_box(&l, break_columns(&l, count, columns));
        const double fits = fmin(1, fmin(width / needed.width, height / needed.height));
        if (fits > size) {
            size = fits;
            best = columns;
        }
    }
    best = size < READABLE ? 1 : best;
    view_box box = help_box(&l, break_columns(&l, count, best));
    size = size < READABLE ? fmin(1, width / box.width) : size;
    box.width *= size;
    box.height *= size;
    *scroll = fmax(0, fmin(*scroll, box.height - height));
    box.x = 0.5 * (width - box.width);
    box.y = fmax(0.5 * (height - box.height), 0) - *scroll;
    ui_box(box.x, box.y, box.width, box.height, size * ui_text_height(), UI_SOLID_PAPER);
    write_help(&l, &box, size);
    return box;
}

/* --- messages --------------------------------------------------------------------------------- */

view_box view_draw_message(const char *text, double room, double x, double y, double pivot) {
    const double em = ui_text_height(), margin = MARGIN * em;
    const double inside = fmax(room - 2 * margin, em);
    double width, height;
    ui_measure(text, 1, inside, &width, &height);
    view_box box = { .width = width + 2 * margin, .height = height + 1.4 * margin };
    box.x = x - pivot * box.width;
    box.y = y - box.height;
    ui_box(box.x, box.y, box.width, box.height, 0.6 * em, UI_PAPER);
    ui_write(box.x + margin, box.y + 0.7 * margin, text, 1, inside, UI_INK);
    return box;
}
