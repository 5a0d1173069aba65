/* SPDX-License-Identifier: MIT */
#include "app/ruler/column.h"
#include "app/file/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BYTES_MAX ((size_t)16 << 20)

typedef struct column {
    const char *path;
    const ruler_table *table;
    bool whole;     /* lines begin with the configurations themselves */
    bool radius;    /* a column after the values, as --truth prints it */
    int *lines;     /* of each row; 0: not seen yet */
    double *values; /* of each row */
} column;

static int compare_ids(const void *id, const void *row) {
    const int a = *(const int *)id, b = ((const ruler_row *)row)->id;
    return (a > b) - (a < b);
}

/* "0.25" or "0.25,1e-9", whose second number is checked and no more: values are judged by the
 * table's own radius. */
static bool read_value(const column *c, int number, const ruler_row *row, const char *text,
                       double *value, cli_error *error) {
    const size_t length = strcspn(text, ",");
    double radius;
    if (!cli_number(text, length, value))
        return cli_fail(error, c->path, "line %d: row %d: \"%.*s\" is not a finite number", number,
                        row->id, (int)length, text);
    if (!c->radius)
        return true;
    const char *const last = text + length + 1;
    return (cli_number(last, strlen(last), &radius) && radius >= 0) ||
           cli_fail(error, c->path, "line %d: row %d: the radius \"%s\" is not a number from 0 on",
                    number, row->id, last);
}

/* Where the columns before the value end: at the last comma, or at the one before it. */
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

/* "17,0.25" or "17,sphere,…,0.25" */
static bool read_line(column *c, int number, const char *line, cli_error *error) {
    const size_t id_length = strcspn(line, ","), length = configuration_length(c, line);
    double id, value;
    if (!cli_number(line, id_length, &id))
        return cli_fail(error, c->path, "line %d: id: \"%.*s\" is not a number", number,
                        (int)id_length, line);
    const int key = id >= 1 && id <= 1e9 && id == floor(id) ? (int)id : 0;
    const ruler_row *const row =
        bsearch(&key, c->table->rows, (size_t)c->table->count, sizeof *c->table->rows, compare_ids);
    if (!row)
        return cli_fail(error, c->path, "line %d: row %.*s is not one of the %d rows asked for",
                        number, (int)id_length, line, c->table->count);
    const size_t index = (size_t)(row - c->table->rows);
    if (c->lines[index])
        return cli_fail(error, c->path, "line %d: row %d is repeated (first on line %d)", number,
                        row->id, c->lines[index]);
    const size_t expected = c->whole ? (size_t)row->length : id_length;
    if (line[length] != ',' || length != expected ||
        (c->whole && memcmp(line, row->text, expected) != 0))
        return cli_fail(error, c->path, "line %d: row %d is not \"%.*s,VALUE%s\"", number, row->id,
                        (int)expected, c->whole ? row->text : line, c->radius ? ",RADIUS" : "");
    if (!read_value(c, number, row, line + length + 1, &value, error))
        return false;
    c->lines[index] = number;
    c->values[index] = value;
    return true;
}

static bool read_header(column *c, const char *line, cli_error *error) {
    const char *const header = ruler_table_header();
    const size_t length = strlen(header);
    c->whole = strncmp(line, header, length) == 0;
    const char *const end = line + (c->whole ? length : strcspn(line, ","));
    c->radius = strcmp(end, ",value,radius") == 0;
    const bool known = c->whole || strncmp(line, "id,", 3) == 0;
    return (known && (c->radius || strcmp(end, ",value") == 0)) ||
           cli_fail(error, c->path, "the first line must be \"id,value\" or \"%s,value\"", header);
}

static bool read_lines(column *c, char *text, cli_error *error) {
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
    return number > 0 || cli_fail(error, c->path, "is empty");
}

static bool check_complete(const column *c, cli_error *error) {
    int first = -1, missing = 0;
    for (int i = c->table->count - 1; i >= 0; i--)
        if (!c->lines[i]) {
            first = i;
            missing++;
        }
    if (missing == 0)
        return true;
    return cli_fail(error, c->path, "row %d is missing (%d of %d are)", c->table->rows[first].id,
                    missing, c->table->count);
}

bool ruler_column_read(const char *path, const ruler_table *table, double **values,
                       cli_error *error) {
    void *text;
    size_t size;
    column c = { .path = path, .table = table };
    if (!file_read(path, BYTES_MAX, &text, &size, error))
        return false;
    c.lines = calloc((size_t)table->count + 1, sizeof *c.lines);
    c.values = calloc((size_t)table->count + 1, sizeof *c.values);
    bool ok = c.lines && c.values;
    if (!ok)
        cli_fail(error, NULL, "out of memory");
    else if (strlen(text) != size)
        ok = cli_fail(error, path, "is not text");
    ok = ok && read_lines(&c, text, error) && check_complete(&c, error);
    free(text);
    free(c.lines);
    if (!ok)
        free(c.values);
    *values = ok ? c.values : NULL;
    return ok;
}
