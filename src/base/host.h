/* SPDX-License-Identifier: MIT */
/* host.h - the caller's host with every hook in place: its memory, and long work on its threads. */
#ifndef LAMPION_BASE_HOST_H
#define LAMPION_BASE_HOST_H

#include <lampion/base.h>

/* Returns the host given, or the default host where it is NULL, with defaults for the hooks that it
 * leaves out. The functions below must be given a host from here. */
lmp_host lmpi_host_resolve(const lmp_host *host);

void *lmpi_allocate(const lmp_host *host, size_t size);
void lmpi_release(const lmp_host *host, void *memory);

/* Releases an object whose first member is the resolved host that made it; accepts NULL. */
void lmpi_release_object(void *object);

/* Tells the host, between two pieces of work on the calling thread, how much is done; returns
 * LMP_OK or LMP_ERROR_CANCELLED. */
lmp_result lmpi_host_report(const lmp_host *host, double done);

/* Runs `count` tasks on the host's threads and reports progress that rises from `from` to `to`.
 * Once a task fails or the host cancels, the remaining tasks are skipped, and that result is
 * returned. */
typedef lmp_result (*lmpi_host_task)(size_t index, void *data);
lmp_result lmpi_host_run(const lmp_host *host, double from, double to, size_t count,
                         lmpi_host_task task, void *data);

#endif
