/* SPDX-License-Identifier: MIT */
/* check.h - what the tests share: bounds that a NaN fails, seeded random numbers, vector files, a
 * host that fails on demand. */
#ifndef LAMPION_CHECK_H
#define LAMPION_CHECK_H

#include <lampion/base.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

#include <cmocka.h>

/* Ends the test with both numbers unless error <= bound. */
void check_within(double error, double bound, const char *file, int line);
#define CHECK_WITHIN(error, bound)                                                                 \
    check_within((double)(error), (double)(bound), __FILE__, __LINE__)

/* Whether this build asserts its preconditions; and check_skip, which prints why a test does not
 * concern this kind of build: then return from it. */
#ifdef NDEBUG
#define CHECK_ASSERTS false
#else
#define CHECK_ASSERTS true
#endif
void check_skip(const char *why);

/* Returns max |actual - expected| / max |expected|, or the absolute error where all expected values
 * are 0; NaN if any value is NaN. */
double check_error(size_t count, const double *expected, const float *actual);
double check_error_double(size_t count, const double *expected, const double *actual);

/* Errors accumulated one by one; a NaN remains the largest. */
typedef struct check_errors {
    double largest, squares;
    long count;
} check_errors;
void check_errors_add(check_errors *errors, double error);
double check_errors_rms(const check_errors *errors);

/* Returns a test's size: `all` where LAMPION_LONG=1 asks for the full size (./dev test --all), else
 * `some`, which can fail for the same reasons. */
int check_count(int some, int all);

/* Returns the OpenGL device for tests that judge images: software, which every machine has, or the
 * device that LAMPION_TEST_GL_DEVICE names as --gl-device does. */
const char *check_gl_device(void);

/* --- random numbers ---------------------------------------------------------------------------
 * One fixed seed, printed at the first use, settable by the environment variable LAMPION_SEED. */
void check_seed(unsigned long long seed);        /* begins with another seed, and prints it */
double check_random(void);                       /* uniform in [0, 1) */
double check_random_between(double a, double b); /* uniform in [a, b) */
lmp_vec3 check_random_direction(void);
lmp_quat check_random_rotation(void);

/* --- vector files -----------------------------------------------------------------------------
 * Reads ruler/vectors/NAME, whose columns docs/formats-ruler.md has; the test fails without it. */
typedef struct check_csv {
    int rows, columns; /* without the header line */
    char *text;
    const char **cells; /* rows * columns, each a C string */
} check_csv;
check_csv *check_csv_open(const char *name);
void check_csv_close(check_csv *csv);
const char *check_csv_text(const check_csv *csv, int row, int column);
double check_csv_number(const check_csv *csv, int row, int column);
/* `count` numbers of a row from `column` on. */
void check_csv_numbers(const check_csv *csv, int row, int column, int count, double *values);

/* --- a host -----------------------------------------------------------------------------------
 * Its hooks count what is live, refuse request number `refuse` for memory (from 0; < 0: none),
 * cancel at question number `cancel` (from 1; 0: never), run tasks backwards, and end the test if
 * progress falls. */
typedef struct check_hooks {
    int refuse, requests, live;
    int cancel, questions;
    size_t tasks; /* of all runs */
    double done;  /* the last progress */
} check_hooks;
lmp_host check_host(check_hooks *hooks);

#endif
