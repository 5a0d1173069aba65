/* SPDX-License-Identifier: MIT */
/* progress.h - a progress bar. */
#ifndef LAMPION_BASE_PROGRESS_H
#define LAMPION_BASE_PROGRESS_H

/* Shows a progress bar on stderr if that is a terminal, else nothing. done in 0 … 1; may be called
 * any number of times, it draws a few times a second. progress_end clears the line. */
void progress_show(const char *what, double done);
void progress_end(void);

#endif
