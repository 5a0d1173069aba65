/* SPDX-License-Identifier: MIT */
/* Formats the text of an error without the C library's streams: %s, %d and %zu. */
#include "src/base/parse_error.h"

static void add_char(lmp_parse_error *error, size_t *length, char c) {
    if (*length + 1 < sizeof error->text)
        error->text[(*length)++] = c;
}

static void add_number(lmp_parse_error *error, size_t *length, uint64_t value) {
    char digits[20];
    int count = 0;
    do {
        digits[count++] = (char)('0' + value % 10);
        value /= 10;
    } while (value > 0);
    while (count > 0)
        add_char(error, length, digits[--count]);
}

lmp_result lmpi_parse_fail_list(lmp_parse_error *error, lmp_result result, size_t offset,
                                const char *format, va_list list) {
    if (!error)
        return result;
    size_t length = 0;
    for (const char *p = format; *p; p++) {
        if (*p != '%') {
            add_char(error, &length, *p);
        } else if (*++p == 's') {
            for (const char *text = va_arg(list, const char *); *text; text++)
                add_char(error, &length, *text);
        } else if (*p == 'd') {
            const int value = va_arg(list, int);
            if (value < 0)
                add_char(error, &length, '-');
            add_number(error, &length, (uint64_t)(value < 0 ? -(int64_t)value : value));
        } else {
            p++; /* zu */
            add_number(error, &length, va_arg(list, size_t));
        }
    }
    error->text[length] = '\0';
    error->offset = offset;
    return result;
}

lmp_result lmpi_parse_fail(lmp_parse_error *error, lmp_result result, size_t offset,
                           const char *format, ...) {
    va_list list;
    va_start(list, format);
    lmpi_parse_fail_list(error, result, offset, format, list);
    va_end(list);
    return result;
}
