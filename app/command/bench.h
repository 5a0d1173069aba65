/* SPDX-License-Identifier: MIT */
/* bench.h - the two halves of `lampion bench`. */
#ifndef LAMPION_BENCH_H
#define LAMPION_BENCH_H

#include "app/cli/cli.h"

typedef struct bench_options {
    bool json, full;
    int bands;                 /* 0: many */
    int mask, threads, kernel; /* of cpu; kernel 0: all */
    int lights, size[2];       /* of gpu */
    const char *scene;         /* of gpu */
    const char *gl_device;     /* of gpu */
} bench_options;

/* `lampion bench gpu`; returns the exit status. */
int bench_gpu(const bench_options *options);

#endif
