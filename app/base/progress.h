/* SPDX-License-Identifier: MIT */
/* progress.h - a progress bar. */
#ifndef LAMPION_BASE_PROGRESS_H
#define LAMPION_BASE_PROGRESS_H

#include <stdatomic.h>
#include <stdbool.h>

/* Shows a progress bar on stderr if that is a terminal, else nothing. done in 0 … 1; may be called
 * any number of times, it draws a few times a second. progress_end clears the line. */
void progress_show(const char *what, double done);
void progress_end(void);

/* Another thread's view of the work: how much is done, and whether it shall end. */
typedef struct progress_watch {
    atomic_int percent; /* of the present step; 0 between two */
    atomic_bool cancelled;
} progress_watch;

/* Lets `watch`, or NULL: nobody, follow the work from now on. */
void progress_follow(progress_watch *watch);

/* Whether who follows the work has cancelled it; what a sandbox_job asks. */
bool progress_cancelled(void *unused);

#endif
