/* SPDX-License-Identifier: MIT */
#include "app/base/progress.h"
#include "app/base/terminal.h"
#include "app/base/timing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define BAR_WIDTH   30
#define DRAW_PERIOD 0.1 /* seconds */
#define SAY_AFTER   2.0 /* seconds before the time left is shown */

/* The program has one bar: the thread that holds the flag draws it, others pass by. */
static atomic_flag drawing = ATOMIC_FLAG_INIT;
static double last_draw;
static bool drawn;

static progress_watch *_Atomic follower;

/* When the current work was first seen, and how far it was; work that goes back has started
 * again. */
static double first_time, first_done, last_done = 1.0;

/* Writes how long the rest takes at the pace so far, or nothing while that is unknown. */
static void say_time_left(double time, double done, char *text, size_t size) {
    const double spent = time - first_time, rate = (done - first_done) / spent;
    text[0] = '\0';
    if (spent < SAY_AFTER || !(rate > 0.0))
        return;
    const double left = (1.0 - done) / rate;
    if (left < 3600.0)
        snprintf(text, size, ", %d:%02d left", (int)left / 60, (int)left % 60);
    else
        snprintf(text, size, ", %.1f h left", left / 3600.0);
}

static void draw(const char *what, double time, double done) {
    const double part = done >= 0.0 && done <= 1.0 ? done : done > 1.0 ? 1.0 : 0.0;
    char bar[BAR_WIDTH + 1], left[48];
    memset(bar, ' ', BAR_WIDTH);
    memset(bar, '=', (size_t)(part * BAR_WIDTH));
    bar[BAR_WIDTH] = '\0';
    say_time_left(time, part, left, sizeof left);
    fprintf(stderr, "\r%.40s [%s] %3.0f%%%s\033[K", what, bar, 100.0 * part, left);
    fflush(stderr);
}

/* Tells who follows the work. */
static void tell(double done) {
    progress_watch *const watch = atomic_load(&follower);
    if (watch)
        atomic_store(&watch->percent, (int)(100.0 * done));
}

void progress_show(const char *what, double done) {
    if (atomic_flag_test_and_set(&drawing))
        return;
    const double time = timing_now();
    if (done < last_done) {
        first_time = time;
        first_done = done;
    }
    last_done = done;
    tell(done);
    if (time - last_draw >= DRAW_PERIOD && !terminal_is_quiet() && terminal_can_draw()) {
        draw(what, time, done);
        last_draw = time;
        drawn = true;
    }
    atomic_flag_clear(&drawing);
}

void progress_end(void) {
    while (atomic_flag_test_and_set(&drawing))
        continue;
    if (drawn)
        fputs("\r\033[K", stderr);
    drawn = false;
    last_done = 1.0;
    tell(0.0);
    atomic_flag_clear(&drawing);
}

void progress_follow(progress_watch *watch) {
    atomic_store(&follower, watch);
}

bool progress_cancelled(void *unused) {
    (void)unused;
    progress_watch *const watch = atomic_load(&follower);
    return watch && atomic_load(&watch->cancelled);
}
