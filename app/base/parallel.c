/* SPDX-License-Identifier: MIT */
#include "app/base/parallel.h"

static void run(size_t count, void (*task)(size_t index, void *data), void *data, void *user) {
    (void)user;
    const long tasks = (long)count;
#pragma omp parallel for schedule(dynamic)
    for (long i = 0; i < tasks; i++)
        task((size_t)i, data);
}

lmp_host parallel_host(void) {
    return (lmp_host) { .parallel = run };
}
