/* SPDX-License-Identifier: MIT */
/* bench.h - the two halves of `lampion bench`. */
#ifndef LAMPION_STUDY_BENCH_H
#define LAMPION_STUDY_BENCH_H

#include "app/base/cli.h"

typedef struct bench_options {
    bool json, full;
    int bands;                 /* 0: several */
    int mask, threads, kernel; /* of cpu; kernel 0: all */
    /* of gpu */
    int device, method; /* indices into bench_devices and bench_methods */
    cli_numbers lights; /* empty: several */
    int size[2];        /* 0: several */
    int seconds;        /* 0: a default, or no limit if `full` */
    const char *scene;  /* NULL: several */
    const char *gl_device;
    cli_list materials;
} bench_options;

/* Return the choices of `lampion bench`, NULL-terminated; the first of each is all. */
const char *const *bench_kernel_names(void);
const char *const *bench_devices(void);
const char *const *bench_methods(void);

/* Run `lampion bench cpu` and `lampion bench gpu`; return the exit status. */
int bench_cpu(const bench_options *options);
int bench_gpu(const cli_command *command, const bench_options *options);

#endif
