/* SPDX-License-Identifier: MIT */
/* bench.h - the two halves of `lampion bench`. */
#ifndef LAMPION_BENCH_H
#define LAMPION_BENCH_H

#include "app/cli/cli.h"

/* `lampion bench gpu …`: argv[0] is "gpu". */
int bench_gpu(const cli_command *command, int argc, char **argv);

#endif
