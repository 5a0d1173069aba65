/* SPDX-License-Identifier: MIT */
/* host.h - the caller's host with every hook in place: its memory, and long work on its threads. */
#ifndef LAMPION_BASE_HOST_H
#define LAMPION_BASE_HOST_H

#include <lampion/base.h>

/* The host given, or the default where it is NULL, with defaults for the hooks that it leaves out.
 * What is passed on below must come from here. */
lmp_host lmp_host_resolve(const lmp_host *host);

void *lmp_allocate(const lmp_host *host, size_t size);
void lmp_release(const lmp_host *host, void *memory);

/* Releases an object whose first member is the resolved host that made it; accepts NULL. */
void lmp_release_object(void *object);

/* Between two pieces of work on the calling thread: tells the host how much is done, and returns
 * LMP_OK or LMP_ERROR_CANCELLED. */
lmp_result lmp_host_report(const lmp_host *host, double done);

/* Runs `count` tasks on the host's threads while reporting progress that rises from `from` to `to`.
 * The first that fails, or the host that cancels, spares the rest; that result is returned. */
typedef lmp_result (*lmp_host_task)(size_t index, void *data);
lmp_result lmp_host_run(const lmp_host *host, double from, double to, size_t count,
                        lmp_host_task task, void *data);

#endif
