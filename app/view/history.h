/* SPDX-License-Identifier: MIT */
/* history.h - what undo brings back: the lights at rest, and which materials are replaced. */
#ifndef LAMPION_VIEW_HISTORY_H
#define LAMPION_VIEW_HISTORY_H

#include "app/view/settings.h"

#define VIEW_HISTORY_BYTES ((size_t)64 << 20)
enum { VIEW_HISTORY_MAX = 256 };

/* Lights, their numbers for the animation, and materials, at one time. */
typedef struct view_moment view_moment;

typedef struct view_history {
    view_moment *moments[VIEW_HISTORY_MAX]; /* owned, oldest first */
    int count, at;                          /* at: the present one */
    size_t bytes;
} view_history;

/* Adds the present as a moment if it differs from the last one; what was undone before is then
 * lost, as are the oldest moments where they are too many. Without memory nothing is kept. */
void view_history_keep(view_history *history, const view_settings *now, const size_t *numbers);

/* Goes by one moment, back with -1 and forward with 1; false where there is none. */
bool view_history_step(view_history *history, int step, view_settings *now, size_t *numbers);

void view_history_clear(view_history *history);

#endif
