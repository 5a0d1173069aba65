/* SPDX-License-Identifier: MIT */
/* parallel.h - the library's work on all cores. */
#ifndef LAMPION_BASE_PARALLEL_H
#define LAMPION_BASE_PARALLEL_H

#include <lampion/base.h>

/* Returns a host that runs tasks on all cores and is otherwise the default. */
lmp_host parallel_host(void);

#endif
