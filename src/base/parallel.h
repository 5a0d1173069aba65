/* SPDX-License-Identifier: MIT */
/* parallel.h - tasks on the host's threads where it lends some, or here one after another. */
#ifndef LAMPION_BASE_PARALLEL_H
#define LAMPION_BASE_PARALLEL_H

#include <lampion/base.h>

static inline void lmp_parallel_run(lmp_parallel parallel, void *user, size_t count,
                                    void (*task)(size_t index, void *data), void *data) {
    if (parallel) {
        parallel(user, count, task, data);
        return;
    }
    for (size_t i = 0; i < count; i++)
        task(i, data);
}

#endif
