/* SPDX-License-Identifier: MIT */
/* parse_error.h - says what is wrong with foreign bytes. */
#ifndef LAMPION_BASE_PARSE_ERROR_H
#define LAMPION_BASE_PARSE_ERROR_H

#include <lampion/base.h>

#include <stdarg.h>

/* Fills the error (may be NULL) and returns `result`. The format knows %s, %d and %zu. */
lmp_result lmpi_parse_fail(lmp_parse_error *error, lmp_result result, size_t offset,
                           const char *format, ...) __attribute__((format(printf, 4, 5)));
lmp_result lmpi_parse_fail_list(lmp_parse_error *error, lmp_result result, size_t offset,
                                const char *format, va_list list)
    __attribute__((format(printf, 4, 0)));

#endif
