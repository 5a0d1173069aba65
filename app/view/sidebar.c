/* SPDX-License-Identifier: MIT */
/* sidebar.c - every action as a button. */
#include "app/view/ui.h"
#include "app/view/viewer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* --- actions ---------------------------------------------------------------------------------- */

static bool is_heading(const view_key *row) {
    return !row->key && !row->help;
}

/* Puts the buttons of the rows below a heading, each with its help and key as the tooltip; returns
 * the next heading. */
static const view_key *put_buttons(view_state *s, const view_key *heading) {
    const view_key *row = heading + 1, *told = row;
    for (; (row->key || row->shown) && !is_heading(row); row++) {
        char tip[128];
        if (row->help)
            told = row;
        if (!row->name)
            continue;
        snprintf(tip, sizeof tip, "%s (%s)", told->help, told->shown);
        if (ui_button(row->name, tip))
            view_handle(s, &(view_event) { .kind = VIEW_ACT, .text = row->name });
    }
    return row;
}

/* Returns the heading after this one. */
static const view_key *next_heading(const view_key *row) {
    do
        row++;
    while ((row->key || row->shown) && !is_heading(row));
    return row;
}

/* --- all of it -------------------------------------------------------------------------------- */

double view_draw_sidebar(viewer *v) {
    view_state *s = &v->state;
    const int width = s->now.width;
    const bool offered = !v->options->script && !v->options->record;
    if (!s->sidebar && !offered)
        return width;
    const double wide = fmin(VIEW_SIDEBAR_WIDTH * v->scale, 0.5 * width);
    bool open = s->sidebar;
    const bool seen = ui_sidebar_begin(VIEW_SIDEBAR_TITLE, wide, &open);
    s->sidebar = open;
    if (seen)
        for (const view_key *row = view_keys; row->shown; row = next_heading(row))
            if (ui_section(row->shown))
                put_buttons(s, row);
    ui_sidebar_end();
    return open ? width - wide : width;
}
