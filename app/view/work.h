/* SPDX-License-Identifier: MIT */
/* work.h - slow work beside the window: on a thread of its own, while the window's thread takes
 * events and draws the interface. */
#ifndef LAMPION_VIEW_WORK_H
#define LAMPION_VIEW_WORK_H

#include "app/render/frame.h"

/* A thread, and what is to be done meanwhile. One task runs at a time. */
typedef struct view_work view_work;

/* Starts the thread. While a task runs, `meanwhile` is called again and again on the thread that
 * waits for it; it must not run another task. Returns NULL on failure. */
view_work *view_work_begin(void (*meanwhile)(void *user), void *user, base_error *error);
void view_work_end(view_work *work);

/* Runs a task, which must not use OpenGL, and returns what it returns. work: NULL, to run it on the
 * calling thread and do nothing meanwhile. */
bool view_work_run(view_work *work, bool (*task)(void *of), void *of);

/* Returns the progress of the task, new for each; frames that it draws may follow it. */
render_progress *view_work_progress(view_work *work);

#endif
