/* SPDX-License-Identifier: MIT */
#include "app/scene/sgd_file.h"
#include "app/base/number.h"

#include <string.h>

enum { SGD_NUMBERS = 33 };

/* Reads the numbers of one line of a table: material, alias, then three of each parameter. */
static bool read_sgd_row(const char *line, lmp_sgd *sgd) {
    double *const parameters[11] = { sgd->rho_d, sgd->rho_s, sgd->alpha, sgd->p,
                                     sgd->f0,    sgd->f1,    sgd->k_ap,  sgd->lambda,
                                     sgd->c,     sgd->k,     sgd->theta0 };
    const char *at = line;
    for (int i = 0; i < 2; i++) {
        at = strchr(at, ',');
        if (!at)
            return false;
        at++;
    }
    for (int i = 0; i < SGD_NUMBERS; i++) {
        const size_t length = strcspn(at, ",\r\n");
        if (!number_read(at, length, &parameters[i / 3][i % 3]))
            return false;
        at += length + (at[length] == ',');
    }
    return true;
}

/* Whether one of the first two cells of a line is `name`. */
static bool is_row_of(const char *line, const char *name) {
    const size_t length = strlen(name);
    for (int i = 0; i < 2; i++) {
        const size_t cell = strcspn(line, ",\r\n");
        if (cell == length && memcmp(line, name, length) == 0)
            return true;
        if (line[cell] != ',')
            return false;
        line += cell + 1;
    }
    return false;
}

bool sgd_file_find(const char *text, const char *name, const char *subject, lmp_sgd *sgd,
                   base_error *error) {
    const char *line = text;
    while (*line && !is_row_of(line, name)) {
        line += strcspn(line, "\n");
        line += *line == '\n';
    }
    if (!*line)
        return base_fail(error, subject, "no material %s in this table", name);
    return read_sgd_row(line, sgd) ||
           base_fail(error, subject, "the row of %s has not 33 numbers after its names", name);
}
