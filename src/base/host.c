/* SPDX-License-Identifier: MIT */
#include "src/base/host.h"

#include <assert.h>
#include <stdatomic.h>
#include <stdlib.h>

/* --- defaults --------------------------------------------------------------------------------- */

static void *default_allocate(size_t size, void *user) {
    (void)user;
    return malloc(size);
}

static void default_release(void *memory, void *user) {
    (void)user;
    free(memory);
}

static void default_parallel(size_t count, void (*task)(size_t index, void *data), void *data,
                             void *user) {
    (void)user;
    for (size_t i = 0; i < count; i++)
        task(i, data);
}

static void default_progress(double done, void *user) {
    (void)done;
    (void)user;
}

static bool default_cancelled(void *user) {
    (void)user;
    return false;
}

lmp_host lmpi_host_resolve(const lmp_host *host) {
    lmp_host resolved = host ? *host : (lmp_host) { 0 };
    assert(!resolved.allocate == !resolved.release);
    if (!resolved.allocate) {
        resolved.allocate = default_allocate;
        resolved.release = default_release;
    }
    if (!resolved.parallel)
        resolved.parallel = default_parallel;
    if (!resolved.progress)
        resolved.progress = default_progress;
    if (!resolved.cancelled)
        resolved.cancelled = default_cancelled;
    return resolved;
}

void *lmpi_allocate(const lmp_host *host, size_t size) {
    return host->allocate(size, host->user);
}

void lmpi_release(const lmp_host *host, void *memory) {
    host->release(memory, host->user);
}

void lmpi_release_object(void *object) {
    if (!object)
        return;
    const lmp_host host = *(const lmp_host *)object;
    lmpi_release(&host, object);
}

/* --- long work -------------------------------------------------------------------------------- */

lmp_result lmpi_host_report(const lmp_host *host, double done) {
    host->progress(done, host->user);
    return host->cancelled(host->user) ? LMP_ERROR_CANCELLED : LMP_OK;
}

typedef struct run {
    const lmp_host *host;
    double from, to;
    size_t count;
    lmpi_host_task task;
    void *data;
    atomic_size_t done;
    atomic_int result; /* lmp_result of the last task that failed */
    atomic_flag reporting;
} run;

/* Runs tasks; one thread reports while the others go on, so reports never overlap and never fall.
 */
static void report_tasks(run *r) {
    if (atomic_flag_test_and_set(&r->reporting))
        return;
    const size_t done = atomic_load(&r->done);
    if (done < r->count)
        r->host->progress(r->from + (r->to - r->from) * (double)done / (double)r->count,
                          r->host->user);
    atomic_flag_clear(&r->reporting);
}

static void run_task(size_t index, void *data) {
    run *r = data;
    if (atomic_load(&r->result) != LMP_OK)
        return;
    const lmp_result result =
        r->host->cancelled(r->host->user) ? LMP_ERROR_CANCELLED : r->task(index, r->data);
    if (result != LMP_OK) {
        atomic_store(&r->result, (int)result);
        return;
    }
    atomic_fetch_add(&r->done, 1);
    report_tasks(r);
}

lmp_result lmpi_host_run(const lmp_host *host, double from, double to, size_t count,
                         lmpi_host_task task, void *data) {
    run r = { .host = host,
              .from = from,
              .to = to,
              .count = count,
              .task = task,
              .data = data,
              .reporting = ATOMIC_FLAG_INIT };
    host->parallel(count, run_task, &r, host->user);
    const lmp_result result = (lmp_result)atomic_load(&r.result);
    if (result == LMP_OK)
        host->progress(to, host->user);
    return result;
}
