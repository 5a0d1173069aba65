/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void check_within(double error, double bound, const char *file, int line) {
    if (!(error <= bound)) {
        print_error("error %.3g is not within %.3g\n", error, bound);
        _fail(file, line);
    }
}

double check_error_double(size_t count, const double *expected, const double *actual) {
    double largest = 0, scale = 0;
    for (size_t i = 0; i < count; i++) {
        const double error = fabs(actual[i] - expected[i]);
        if (!(error <= largest))
            largest = error;
        if (isnan(error))
            return error;
        scale = fmax(scale, fabs(expected[i]));
    }
    return scale > 0 ? largest / scale : largest;
}

void check_skip(const char *why) {
    print_message("skipped: %s\n", why);
}

double check_error(size_t count, const double *expected, const float *actual) {
    double *wide = malloc(count * sizeof *wide);
    if (!wide)
        abort();
    for (size_t i = 0; i < count; i++)
        wide[i] = (double)actual[i];
    const double error = check_error_double(count, expected, wide);
    free(wide);
    return error;
}

void check_errors_add(check_errors *errors, double error) {
    if (!(error <= errors->largest) && !isnan(errors->largest))
        errors->largest = error;
    errors->squares += error * error;
    errors->count++;
}

double check_errors_rms(const check_errors *errors) {
    return sqrt(errors->squares / (double)errors->count);
}

int check_count(int some, int all) {
    const char *given = getenv("LAMPION_LONG");
    return given && strcmp(given, "1") == 0 ? all : some;
}

const char *check_gl_device(void) {
    const char *given = getenv("LAMPION_TEST_GL_DEVICE");
    return given ? given : "software";
}

/* --- random numbers --------------------------------------------------------------------------- */

static uint64_t random_state;
static bool seeded;

void check_seed(unsigned long long seed) {
    random_state = seed;
    seeded = true;
    print_message("seed: %llu (LAMPION_SEED sets the first)\n", seed);
}

/* Returns random bits by splitmix64. */
static uint64_t random_bits(void) {
    if (!seeded) {
        const char *given = getenv("LAMPION_SEED");
        check_seed(given ? strtoull(given, NULL, 0) : 2020);
    }
    uint64_t z = random_state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

double check_random(void) {
    return (double)(random_bits() >> 11) * 0x1p-53;
}

double check_random_between(double a, double b) {
    return a + (b - a) * check_random();
}

lmp_vec3 check_random_direction(void) {
    const double z = check_random_between(-1, 1), phi = check_random_between(-3.14159, 3.14159);
    const double s = sqrt(1 - z * z);
    return (lmp_vec3) { (float)(s * cos(phi)), (float)(s * sin(phi)), (float)z };
}

lmp_quat check_random_rotation(void) {
    double q[4], length;
    do {
        length = 0;
        for (int k = 0; k < 4; k++) {
            q[k] = check_random_between(-1, 1);
            length += q[k] * q[k];
        }
    } while (length > 1 || length < 0.01);
    length = sqrt(length);
    return (lmp_quat) { (float)(q[0] / length), (float)(q[1] / length), (float)(q[2] / length),
                        (float)(q[3] / length) };
}

/* --- vector files ----------------------------------------------------------------------------- */

static char *read_text(const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "ruler/vectors/%s", name);
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s is not there: tests run in the source folder", path);
    size_t size = 0, room = 1 << 20;
    char *text = malloc(room);
    while (text) {
        size += fread(text + size, 1, room - 1 - size, file);
        if (size < room - 1)
            break;
        text = realloc(text, room *= 2);
    }
    fclose(file);
    if (!text)
        abort();
    text[size] = 0;
    return text;
}

static int count_char(const char *text, char c, char end) {
    int count = 0;
    for (; *text && *text != end; text++)
        count += *text == c;
    return count;
}

check_csv *check_csv_open(const char *name) {
    char *text = read_text(name);
    check_csv *csv = malloc(sizeof *csv);
    if (!csv)
        abort();
    *csv = (check_csv) { .columns = count_char(text, ',', '\n') + 1, .text = text };
    csv->rows = count_char(text, '\n', 0) - 1;
    assert_true(csv->rows > 0);
    csv->cells = malloc(sizeof *csv->cells * (size_t)csv->rows * (size_t)csv->columns);
    if (!csv->cells)
        abort();
    char *cell = strchr(text, '\n') + 1;
    for (int i = 0; i < csv->rows * csv->columns; i++) {
        csv->cells[i] = cell;
        cell += strcspn(cell, ",\r\n");
        while (*cell == '\r')
            *cell++ = 0;
        *cell++ = 0;
    }
    return csv;
}

void check_csv_close(check_csv *csv) {
    free(csv->cells);
    free(csv->text);
    free(csv);
}

const char *check_csv_text(const check_csv *csv, int row, int column) {
    return csv->cells[row * csv->columns + column];
}

double check_csv_number(const check_csv *csv, int row, int column) {
    return strtod(check_csv_text(csv, row, column), NULL);
}

void check_csv_numbers(const check_csv *csv, int row, int column, int count, double *values) {
    for (int i = 0; i < count; i++)
        values[i] = check_csv_number(csv, row, column + i);
}

/* --- a host ----------------------------------------------------------------------------------- */

static void *host_allocate(size_t size, void *user) {
    check_hooks *hooks = user;
    if (hooks->requests++ == hooks->refuse)
        return NULL;
    hooks->live++;
    return malloc(size);
}

static void host_release(void *memory, void *user) {
    check_hooks *hooks = user;
    hooks->live -= memory != NULL;
    free(memory);
}

static void host_parallel(size_t count, void (*task)(size_t index, void *data), void *data,
                          void *user) {
    check_hooks *hooks = user;
    hooks->tasks += count;
    for (size_t i = count; i-- > 0;)
        task(i, data);
}

static void host_progress(double done, void *user) {
    check_hooks *hooks = user;
    assert_true(done >= hooks->done && done <= 1);
    hooks->done = done;
}

static bool host_cancelled(void *user) {
    check_hooks *hooks = user;
    return ++hooks->questions == hooks->cancel;
}

lmp_host check_host(check_hooks *hooks) {
    return (lmp_host) { .allocate = host_allocate,
                        .release = host_release,
                        .parallel = host_parallel,
                        .progress = host_progress,
                        .cancelled = host_cancelled,
                        .user = hooks };
}
