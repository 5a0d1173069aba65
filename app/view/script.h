/* SPDX-License-Identifier: MIT */
/* script.h - files of timed events (docs/viewer.md), for reproducible demonstrations. */
#ifndef LAMPION_VIEW_SCRIPT_H
#define LAMPION_VIEW_SCRIPT_H

#include "app/view/state.h"

typedef enum view_script_kind {
    VIEW_SCRIPT_EVENT,
    VIEW_SCRIPT_SHOT,
    VIEW_SCRIPT_EXPORT
} view_script_kind;

typedef struct view_script_line {
    double seconds;
    view_script_kind kind;
    view_event event;
    char text[VIEW_PATH_SIZE]; /* the text that event.text points to, or the file to write */
} view_script_line;

typedef struct view_script {
    view_script_line *lines; /* in ascending order of time */
    size_t count;
} view_script;

bool view_script_read(const char *path, view_script *script, base_error *error);
void view_script_free(view_script *script);

#endif
