/* SPDX-License-Identifier: MIT */
/* csv.h - long tables of numbers, a line at a time: strict reading, fast printing. */
#ifndef LAMPION_BASE_CSV_H
#define LAMPION_BASE_CSV_H

#include "app/base/error.h"

#include <stdio.h>

#define CSV_LINE_MAX 65536 /* bytes of a line */
#define CSV_TEXT_MAX 16    /* most bytes that csv_format writes */

/* A table being read. */
typedef struct csv_reader {
    FILE *stream;
    const char *name;   /* for messages */
    bool more;          /* whether the header has its optional end */
    size_t line_number; /* of the line read last, from 1 */
    size_t begin, end;  /* of the unread bytes in buffer */
    char buffer[CSV_LINE_MAX];
} csv_reader;

/* Opens a table ("-": standard input) whose first line must be `header`, in which an end in
 * brackets is optional: "a,b[,c]". */
bool csv_open(csv_reader *reader, const char *path, const char *header, base_error *error);
/* Opens a table from an open stream, which the reader then owns; with header NULL the table has no
 * header line. */
bool csv_open_stream(csv_reader *reader, FILE *stream, const char *name, const char *header,
                     base_error *error);
void csv_close(csv_reader *reader);

typedef enum csv_result { CSV_ROW, CSV_END, CSV_ERROR } csv_result;

/* Reads the numbers of the next line, which must be `count`, finite as floats. names[i] is the
 * column's, for messages. Blanks around a number or a column's name do not count. Empty lines may
 * only end the table. */
csv_result csv_read_row(csv_reader *reader, const char *const *names, int count, float *values,
                        base_error *error);

/* Reports what is wrong with the line read last. Returns CSV_ERROR. */
csv_result csv_line_error(const csv_reader *reader, base_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Prints a finite value as %.9g does, which brings any float back exactly; a zero has no sign.
 * Returns the length; there is no NUL at the end. */
size_t csv_format(float value, char text[CSV_TEXT_MAX]);

#endif
