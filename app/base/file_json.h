/* SPDX-License-Identifier: MIT */
/* file_json.h - JSON: texts read strictly, values taken from them, values written. */
#ifndef LAMPION_BASE_FILE_JSON_H
#define LAMPION_BASE_FILE_JSON_H

#include "app/base/error.h"

#include <jansson.h>
#include <stddef.h>

/* --- reading ---------------------------------------------------------------------------------- */

/* Parses one JSON value, after which nothing may follow; a byte that is not UTF-8 is read as a
 * question mark, and every number as a real one. The file is named in the error. Free with
 * json_decref; returns NULL on failure. */
json_t *file_parse_json(const char *path, const char *text, size_t size, base_error *error);
json_t *file_read_json(const char *path, size_t limit, base_error *error);

/* Calls jansson's parser with the flags of file_parse_json; returns NULL with an error, whose code
 * is json_error_out_of_memory if memory ran out. */
json_t *file_json_load(const char *text, size_t size, json_error_t *error);

/* Read values strictly: a value of another type, count or range is not read. An item may be
 * NULL. */
bool file_json_number(const json_t *item, double minimum, double maximum, double *number);
bool file_json_numbers(const json_t *item, size_t count, double minimum, double maximum,
                       double *numbers);

/* Returns the first key of an object that is none of the NULL-terminated `known` ones, or NULL. */
const char *file_json_unknown_key(json_t *object, const char *const *known);

/* Returns the array of { "name": [ … ] } from a file that holds nothing else, or NULL on
 * failure. */
json_t *file_json_list(const char *path, const json_t *root, const char *name, base_error *error);

/* --- writing ---------------------------------------------------------------------------------- */

/* Make values; return NULL if memory ran out. Bytes of a text that are not UTF-8 become U+FFFD,
 * floats the shortest decimal numbers that read back as the same floats, numbers that are not
 * finite null. */
json_t *file_json_string(const char *text);
json_t *file_json_real(double number);
json_t *file_json_float(float number);
json_t *file_json_floats(const float *numbers, size_t count);

/* Add a member to an object, or an entry to an array, and take both. If memory ran out here, or
 * either is NULL, free both and return NULL: what these functions build is complete or NULL. */
json_t *file_json_with(json_t *object, const char *name, json_t *value);
json_t *file_json_append(json_t *array, json_t *value);

/* Does what json_dumps does; returns NULL if memory ran out. */
char *file_json_dump(const json_t *root, size_t flags);

/* Returns the text of a JSON value, in several lines or in one, to be freed. Takes the value; NULL
 * means that memory ran out before. Returns NULL then, and if memory runs out here. */
char *file_json_text(json_t *root, bool lines, const char *subject, base_error *error);

/* Prints the text of a JSON value in several lines to stdout. Characters in file names that a
 * terminal would obey are escaped. */
bool file_json_print(json_t *root, const char *subject, base_error *error);

#endif
