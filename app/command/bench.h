/* SPDX-License-Identifier: MIT */
/* bench.h - the two halves of `lampion bench`. */
#ifndef LAMPION_BENCH_H
#define LAMPION_BENCH_H

#include "app/cli/cli.h"

typedef struct bench_options {
    bool json, full;
    int mask, threads;          /* of cpu */
    int bands, lights, size[2]; /* of gpu; bands 0: many */
    const char *gl_device;      /* of gpu */
} bench_options;

/* `lampion bench gpu`; returns the exit status. */
int bench_gpu(const bench_options *options);

#endif
