/* SPDX-License-Identifier: MIT */
/* terminal.h - whether stderr is a terminal, and whether it gets more than errors. */
#ifndef LAMPION_BASE_TERMINAL_H
#define LAMPION_BASE_TERMINAL_H

#include <stdbool.h>

/* Silences base_note and progress_show from now on (--quiet, which every command takes). */
void terminal_be_quiet(void);

/* Whether terminal_be_quiet was called. */
bool terminal_is_quiet(void);

/* Whether stderr is a terminal that can overwrite a line. */
bool terminal_can_draw(void);

#endif
