/* SPDX-License-Identifier: MIT */
/* history.h - what undo restores: the lights at rest, the replaced materials, the hidden nodes. */
#ifndef LAMPION_VIEW_HISTORY_H
#define LAMPION_VIEW_HISTORY_H

#include "app/view/settings.h"

#define VIEW_HISTORY_BYTES ((size_t)64 << 20)
enum { VIEW_HISTORY_MAX = 256 };

/* Lights, their numbers for the animation, materials and hidden nodes at one time. */
typedef struct view_moment view_moment;

typedef struct view_history {
    view_moment *moments[VIEW_HISTORY_MAX]; /* owned, oldest first */
    int count, at;                          /* at: index of the present one */
    size_t bytes;
} view_history;

/* Adds the present as a moment if it differs from the last one. Moments after the present one,
 * which had been undone, are lost, as are the oldest beyond the limits. If memory runs out, the
 * history is cleared. */
void view_history_keep(view_history *history, const view_settings *now, const size_t *numbers);

/* Goes back one moment with -1, or forward with 1; returns false if there is none. */
bool view_history_step(view_history *history, int step, view_settings *now, size_t *numbers);

void view_history_clear(view_history *history);

#endif
