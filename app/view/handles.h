/* SPDX-License-Identifier: MIT */
/* handles.h - what can be dragged at the selected light (docs/aiming.md): arrows and squares that
 * move it, a ring and knobs for its size, its direction and its angles. */
#ifndef LAMPION_VIEW_HANDLES_H
#define LAMPION_VIEW_HANDLES_H

#include "app/view/state.h"
#include "app/view/ui.h"

extern const char *const view_handle_names[VIEW_HANDLES];

/* A drawing in pixels that belongs to a handle. */
enum { VIEW_MARK_POINTS = 64, VIEW_MARKS_MAX = 32 };
typedef struct view_mark {
    view_handle_kind handle;
    ui_shape shape;
    int count;
    float at[VIEW_MARK_POINTS][2];
} view_mark;

typedef struct view_marks {
    int count;
    bool hidden; /* whether a surface is in front of the light */
    view_mark of[VIEW_MARKS_MAX];
} view_marks;

/* Finds the marks of the selected light. While handles are off or an aim is chosen, they are the
 * ring around it alone, which is no handle then. */
void view_find_marks(const view_state *state, view_marks *marks);

/* Returns the handle under the pointer. */
view_handle_kind view_handle_at_pointer(const view_state *state, const view_marks *marks);

/* Begins a drag of the handle under the pointer. Returns false if there is none. */
bool view_handle_begin(view_state *state);

/* Follows the pointer; while Ctrl is held, by steps. */
void view_handle_follow(view_state *state);

/* Describes what the dragged handle has done: "x +0.25", "radius 0.3", "outer 35.0°". */
void view_handle_describe(const view_state *state, char *text, size_t size);

/* Returns the length by which Ctrl lets positions and sizes change: a tenth of the power of ten
 * that is nearest to a tenth of the scene's diagonal. */
double view_handle_step(const view_state *state);

#endif
