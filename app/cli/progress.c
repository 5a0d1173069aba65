/* SPDX-License-Identifier: MIT */
#include "app/cli/cli.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define BAR_WIDTH   30
#define DRAW_PERIOD 0.1 /* seconds */

/* One bar a program: whoever holds the flag draws, other threads pass by. */
static atomic_flag drawing = ATOMIC_FLAG_INIT;
static double last_draw;
static bool drawn;

static bool is_terminal(void) {
    const char *const kind = getenv("TERM");
    return isatty(STDERR_FILENO) && kind && strcmp(kind, "dumb") != 0;
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void draw(const char *what, double done) {
    const double part = done >= 0.0 && done <= 1.0 ? done : done > 1.0 ? 1.0 : 0.0;
    char bar[BAR_WIDTH + 1];
    memset(bar, ' ', BAR_WIDTH);
    memset(bar, '=', (size_t)(part * BAR_WIDTH));
    bar[BAR_WIDTH] = '\0';
    fprintf(stderr, "\r%.40s [%s] %3.0f%%", what, bar, 100.0 * part);
    fflush(stderr);
}

void cli_progress(const char *what, double done) {
    if (atomic_flag_test_and_set(&drawing))
        return;
    const double time = now();
    if (time - last_draw >= DRAW_PERIOD && is_terminal()) {
        draw(what, done);
        last_draw = time;
        drawn = true;
    }
    atomic_flag_clear(&drawing);
}

void cli_progress_end(void) {
    while (atomic_flag_test_and_set(&drawing))
        continue;
    if (drawn)
        fputs("\r\033[K", stderr);
    drawn = false;
    atomic_flag_clear(&drawing);
}
