/* SPDX-License-Identifier: MIT */
#include "app/truth/ruler_column.h"
#include "app/base/file.h"
#include "app/base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BYTES_MAX ((size_t)16 << 20)

typedef struct column {
    const char *path;
    const ruler_table *table;
    bool whole;     /* whether lines repeat the configurations */
    bool radius;    /* whether a column of radii follows the values, as --truth prints it */
    int *lines;     /* where each row was read; 0: not yet */
    double *values; /* one per row */
} column;

static int compare_ids(const void *id, const void *row) {
    const int a = *(const int *)id, b = ((const ruler_row *)row)->id;
    return (a > b) - (a < b);
}

/* Reads "0.25" or "0.25,1e-9". The second number is only checked: values are compared with the
 * table's own radius. */
static bool read_value(const column *c, int number, const ruler_row *row, const char *text,
                       double *value, base_error *error) {
    const size_t length = strcspn(text, ",");
    double radius;
    if (!number_read(text, length, value))
        return base_fail(error, c->path, "line %d: row %d: \"%.*s\" is not a finite number", number,
                         row->id, (int)length, text);
    if (!c->radius)
        return true;
    const char *const last = text + length + 1;
    return (number_read(last, strlen(last), &radius) && radius >= 0) ||
           base_fail(error, c->path, "line %d: row %d: the radius \"%s\" is not a number from 0 on",
                     number, row->id, last);
}

/* Returns where the columns before the value end: at the last comma, or at the one before it. */
static size_t configuration_length(const column *c, const char *line) {
    size_t length = strlen(line);
    for (int columns = c->radius ? 2 : 1; columns > 0; columns--) {
        while (length > 0 && line[length - 1] != ',')
            length--;
        if (length > 0)
            length--;
    }
    return length;
}

/* Reads "17,0.25" or "17,sphere,…,0.25". */
static bool read_line(column *c, int number, const char *line, base_error *error) {
    const size_t id_length = strcspn(line, ","), length = configuration_length(c, line);
    double id, value;
    if (!number_read(line, id_length, &id))
        return base_fail(error, c->path, "line %d: id: \"%.*s\" is not a number", number,
                         (int)id_length, line);
    const int key = id >= 1 && id <= 1e9 && id == floor(id) ? (int)id : 0;
    const ruler_row *const row =
        bsearch(&key, c->table->rows, (size_t)c->table->count, sizeof *c->table->rows, compare_ids);
    if (!row)
        return base_fail(error, c->path, "line %d: row %.*s is not one of the %d rows asked for",
                         number, (int)id_length, line, c->table->count);
    const size_t index = (size_t)(row - c->table->rows);
    if (c->lines[index])
        return base_fail(error, c->path, "line %d: row %d is repeated (first on line %d)", number,
                         row->id, c->lines[index]);
    const size_t expected = c->whole ? (size_t)row->length : id_length;
    if (line[length] != ',' || length != expected ||
        (c->whole && memcmp(line, row->text, expected) != 0))
        return base_fail(error, c->path, "line %d: row %d is not \"%.*s,VALUE%s\"", number, row->id,
                         (int)expected, c->whole ? row->text : line, c->radius ? ",RADIUS" : "");
    if (!read_value(c, number, row, line + length + 1, &value, error))
        return false;
    c->lines[index] = number;
    c->values[index] = value;
    return true;
}

static bool read_header(column *c, const char *line, base_error *error) {
    const char *const header = ruler_table_header();
    const size_t length = strlen(header);
    c->whole = strncmp(line, header, length) == 0;
    const char *const end = line + (c->whole ? length : strcspn(line, ","));
    c->radius = strcmp(end, ",value,radius") == 0;
    const bool known = c->whole || strncmp(line, "id,", 3) == 0;
    return (known && (c->radius || strcmp(end, ",value") == 0)) ||
           base_fail(error, c->path, "the first line must be \"id,value\" or \"%s,value\"", header);
}

static bool read_lines(column *c, char *text, base_error *error) {
    int number = 0;
    for (char *line = text, *next; *line; line = next) {
        size_t length = strcspn(line, "\n");
        next = line + length + (line[length] == '\n');
        if (length > 0 && line[length - 1] == '\r')
            length--;
        line[length] = '\0';
        number++;
        if (!(number == 1 ? read_header(c, line, error) : read_line(c, number, line, error)))
            return false;
    }
    return number > 0 || base_fail(error, c->path, "is empty");
}

static bool check_complete(const column *c, base_error *error) {
    int first = -1, missing = 0;
    for (int i = c->table->count - 1; i >= 0; i--)
        if (!c->lines[i]) {
            first = i;
            missing++;
        }
    if (missing == 0)
        return true;
    return base_fail(error, c->path, "row %d is missing (%d of %d are)", c->table->rows[first].id,
                     missing, c->table->count);
}

bool ruler_column_read(const char *path, const ruler_table *table, double **values,
                       base_error *error) {
    void *text;
    size_t size;
    column c = { .path = path, .table = table };
    if (!file_read(path, BYTES_MAX, &text, &size, error))
        return false;
    c.lines = calloc((size_t)table->count + 1, sizeof *c.lines);
    c.values = calloc((size_t)table->count + 1, sizeof *c.values);
    bool ok = c.lines && c.values;
    if (!ok)
        base_fail(error, NULL, "out of memory");
    else if (strlen(text) != size)
        ok = base_fail(error, path, "is not text");
    ok = ok && read_lines(&c, text, error) && check_complete(&c, error);
    free(text);
    free(c.lines);
    if (!ok)
        free(c.values);
    *values = ok ? c.values : NULL;
    return ok;
}
