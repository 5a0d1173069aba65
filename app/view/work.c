/* SPDX-License-Identifier: MIT */
#include "app/view/work.h"

#include <omp.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

/* Between two calls of `meanwhile`: with the time to draw the interface, an event is answered
 * within two frames of a display. */
enum { NANOSECONDS = 8000000, NANOSECONDS_A_SECOND = 1000000000 };
enum { YIELDING = 5 }; /* by which the thread is nicer than the window's */

struct view_work {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool (*task)(void *of); /* NULL: none */
    void *of;
    bool ok, ends;
    void (*meanwhile)(void *user);
    void *user;
    render_progress progress;
};

static void *serve(void *of) {
    view_work *work = of;
    /* of this thread, on Linux, and of those that it will start: the window comes first */
    setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + YIELDING);
    pthread_mutex_lock(&work->lock);
    while (!work->ends) {
        if (!work->task) {
            pthread_cond_wait(&work->changed, &work->lock);
            continue;
        }
        pthread_mutex_unlock(&work->lock);
        const bool ok = work->task(work->of);
        pthread_mutex_lock(&work->lock);
        work->ok = ok;
        work->task = NULL;
        pthread_cond_broadcast(&work->changed);
    }
    pthread_mutex_unlock(&work->lock);
    return NULL;
}

view_work *view_work_begin(void (*meanwhile)(void *user), void *user, base_error *error) {
    view_work *work = calloc(1, sizeof *work);
    pthread_condattr_t steady;
    if (!work) {
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    work->meanwhile = meanwhile;
    work->user = user;
    pthread_mutex_init(&work->lock, NULL);
    pthread_condattr_init(&steady);
    pthread_condattr_setclock(&steady, CLOCK_MONOTONIC);
    pthread_cond_init(&work->changed, &steady);
    pthread_condattr_destroy(&steady);
    omp_get_max_threads(); /* see app/view/tree.c */
    if (pthread_create(&work->thread, NULL, serve, work) == 0)
        return work;
    free(work);
    base_fail(error, NULL, "no thread can be started");
    return NULL;
}

void view_work_end(view_work *work) {
    if (!work)
        return;
    pthread_mutex_lock(&work->lock);
    work->ends = true;
    pthread_cond_broadcast(&work->changed);
    pthread_mutex_unlock(&work->lock);
    pthread_join(work->thread, NULL);
    pthread_cond_destroy(&work->changed);
    pthread_mutex_destroy(&work->lock);
    free(work);
}

/* Waits a moment for the end of the task, the lock being held. */
static void wait_briefly(view_work *work) {
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += NANOSECONDS;
    if (until.tv_nsec >= NANOSECONDS_A_SECOND) {
        until.tv_nsec -= NANOSECONDS_A_SECOND;
        until.tv_sec++;
    }
    pthread_cond_timedwait(&work->changed, &work->lock, &until);
}

bool view_work_run(view_work *work, bool (*task)(void *of), void *of) {
    if (!work)
        return task(of);
    render_progress_reset(&work->progress, 0);
    atomic_store(&work->progress.cancelled, false);
    pthread_mutex_lock(&work->lock);
    work->task = task;
    work->of = of;
    pthread_cond_broadcast(&work->changed);
    wait_briefly(work);
    while (work->task) {
        pthread_mutex_unlock(&work->lock);
        work->meanwhile(work->user);
        pthread_mutex_lock(&work->lock);
        if (work->task)
            wait_briefly(work);
    }
    pthread_mutex_unlock(&work->lock);
    return work->ok;
}

render_progress *view_work_progress(view_work *work) {
    return &work->progress;
}
