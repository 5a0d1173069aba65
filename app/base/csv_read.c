/* SPDX-License-Identifier: MIT */
#include "app/base/csv.h"
#include "app/base/number.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

#define BYTE_ORDER_MARK "\xEF\xBB\xBF"

/* Moves the unread bytes to the front of the buffer and reads more; returns false at the end of the
 * file. */
static bool refill(csv_reader *reader) {
    memmove(reader->buffer, reader->buffer + reader->begin, reader->end - reader->begin);
    reader->end -= reader->begin;
    reader->begin = 0;
    const size_t room = sizeof reader->buffer - 1 - reader->end;
    const size_t count = fread(reader->buffer + reader->end, 1, room, reader->stream);
    reader->end += count;
    return count > 0;
}

/* Finds the next line and puts NUL in place of its end. */
static csv_result read_line(csv_reader *reader, char **line, size_t *length, base_error *error) {
    char *stop;
    size_t searched = 0;
    while (!(stop = memchr(reader->buffer + reader->begin + searched, '\n',
                           reader->end - reader->begin - searched))) {
        searched = reader->end - reader->begin;
        errno = 0;
        if (refill(reader))
            continue;
        if (ferror(reader->stream)) {
            base_fail(error, reader->name, "cannot read: %s", strerror(errno));
            return CSV_ERROR;
        }
        if (reader->end == sizeof reader->buffer - 1) {
            reader->line_number++;
            return csv_line_error(reader, error, "is longer than %d bytes", CSV_LINE_MAX - 1);
        }
        if (reader->begin == reader->end)
            return CSV_END;
        stop = reader->buffer + reader->end;
        break;
    }
    reader->line_number++;
    *line = reader->buffer + reader->begin;
    *length = (size_t)(stop - *line);
    reader->begin += *length + (stop < reader->buffer + reader->end);
    if (*length > 0 && (*line)[*length - 1] == '\r')
        (*length)--;
    (*line)[*length] = '\0';
    return CSV_ROW;
}

csv_result csv_line_error(const csv_reader *reader, base_error *error, const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    base_fail(error, reader->name, "line %zu: %s", reader->line_number, text);
    return CSV_ERROR;
}

bool csv_open(csv_reader *reader, const char *path, const char *header, base_error *error) {
    const bool standard = strcmp(path, "-") == 0;
    FILE *const stream = standard ? stdin : fopen(path, "rb");
    if (!stream)
        return base_fail(error, path, "%s", strerror(errno));
    return csv_open_stream(reader, stream, standard ? "standard input" : path, header, error);
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

/* Removes blanks from a line of column names, which contain none. */
static void drop_blanks(char *line) {
    char *to = line;
    for (const char *from = line; *from; from++)
        if (!is_blank(*from))
            *to++ = *from;
    *to = '\0';
}

/* Whether a line is the header "a,b[,c]": a,b, or a,b,c, which sets *more. */
static bool is_header(const char *line, const char *header, bool *more) {
    const size_t first = strcspn(header, "["), length = strlen(line);
    const char *end = header + first + (header[first] == '[');
    const size_t rest = strcspn(end, "]");
    *more = length > first;
    return strncmp(line, header, first) == 0 &&
           (length == first || (length == first + rest && strncmp(line + first, end, rest) == 0));
}

bool csv_open_stream(csv_reader *reader, FILE *stream, const char *name, const char *header,
                     base_error *error) {
    reader->stream = stream;
    reader->name = name;
    reader->line_number = reader->begin = reader->end = 0;
    reader->more = false;
    if (!header)
        return true;
    char *line;
    size_t length;
    const csv_result result = read_line(reader, &line, &length, error);
    if (result == CSV_END)
        base_fail(error, reader->name, "is empty (its first line must be %s)", header);
    if (result == CSV_ROW) {
        if (strncmp(line, BYTE_ORDER_MARK, strlen(BYTE_ORDER_MARK)) == 0)
            line += strlen(BYTE_ORDER_MARK);
        drop_blanks(line);
        if (is_header(line, header, &reader->more))
            return true;
        csv_line_error(reader, error, "the header must be %s", header);
    }
    csv_close(reader);
    return false;
}

void csv_close(csv_reader *reader) {
    if (reader->stream && reader->stream != stdin)
        fclose(reader->stream);
    reader->stream = NULL;
}

/* Requires that nothing but empty lines follows an empty line. */
static csv_result read_to_end(csv_reader *reader, base_error *error) {
    const size_t empty = reader->line_number;
    char *line;
    size_t length;
    csv_result result;
    while ((result = read_line(reader, &line, &length, error)) == CSV_ROW)
        if (length > 0) {
            reader->line_number = empty;
            return csv_line_error(reader, error, "is empty");
        }
    return result;
}

csv_result csv_read_row(csv_reader *reader, const char *const *names, int count, float *values,
                        base_error *error) {
    char *line;
    size_t length;
    const csv_result result = read_line(reader, &line, &length, error);
    if (result != CSV_ROW)
        return result;
    if (length == 0)
        return read_to_end(reader, error);
    const char *const line_end = line + length;
    int column = 0;
    for (const char *field = line;; column++) {
        const char *comma = memchr(field, ',', (size_t)(line_end - field));
        const char *field_end = comma ? comma : line_end;
        while (field < field_end && is_blank(*field))
            field++;
        while (field < field_end && is_blank(field_end[-1]))
            field_end--;
        double value;
        if (column < count) {
            if (!number_read(field, (size_t)(field_end - field), &value))
                return csv_line_error(reader, error, "%s: \"%.*s\" is not a number", names[column],
                                      (int)(field_end - field), field);
            if (!(fabs(value) <= (double)FLT_MAX))
                return csv_line_error(reader, error, "%s: %.*s is out of range", names[column],
                                      (int)(field_end - field), field);
            values[column] = (float)value;
        }
        if (!comma)
            break;
        field = comma + 1;
    }
    if (column + 1 != count)
        return csv_line_error(reader, error, "has %d columns, not %d", column + 1, count);
    return CSV_ROW;
}
