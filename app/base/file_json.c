/* SPDX-License-Identifier: MIT */
/* file_json.c - reading JSON. */
#include "app/base/file_json.h"
#include "app/base/file.h"
#include "app/base/printable.h"

#include <stdlib.h>
#include <string.h>

/* --- parsing ---------------------------------------------------------------------------------- */

/* Parses the text with a question mark for each byte that is not UTF-8: names in scenes are
 * sometimes in other encodings. */
static json_t *load_with_question_marks(const char *text, size_t size, json_error_t *error) {
    char *const copy = malloc(size + 1);
    if (!copy) {
        error->text[JSON_ERROR_TEXT_LENGTH - 1] = json_error_out_of_memory;
        return NULL;
    }
    memcpy(copy, text, size);
    copy[size] = '\0';
    for (size_t at = 0; at < size;) {
        uint32_t code;
        const size_t length =
            (unsigned char)copy[at] < 0x80 ? 1 : printable_character(copy + at, &code);
        if (length == 0)
            copy[at] = '?';
        at += length ? length : 1;
    }
    json_t *const root = file_json_load(copy, size, error);
    free(copy);
    return root;
}

/* Returns the last byte before `at` that is not white space, or 0. */
static char before(const char *text, size_t at) {
    while (at > 0 && strchr(" \t\r\n", text[at - 1]))
        at--;
    return at > 0 ? text[at - 1] : '\0';
}

/* Explains a common mistake that the parser's own message says too little about; returns "" for any
 * other. */
static const char *explain(const char *text, size_t size, int position) {
    const size_t end = position > 0 && (size_t)position <= size ? (size_t)position : 0;
    const char last = end > 0 ? text[end - 1] : '\0';
    if (end == 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        return " (a byte-order mark stands before it)";
    if ((last == '}' || last == ']') && before(text, end - 1) == ',')
        return " (a comma stands before the bracket that closes)";
    if (last == '\'')
        return " (names and texts stand in double quotes)";
    if (last == '/' || last == '#')
        return " (JSON has no comments)";
    if (last == '+' || last == '.')
        return " (a number begins with a digit or -)";
    return "";
}

json_t *file_parse_json(const char *path, const char *text, size_t size, base_error *error) {
    json_error_t wrong;
    json_t *root = file_json_load(text, size, &wrong);
    if (!root && json_error_code(&wrong) == json_error_invalid_utf8)
        root = load_with_question_marks(text, size, &wrong);
    if (root)
        return root;
    if (json_error_code(&wrong) == json_error_out_of_memory)
        base_fail(error, path, "is JSON that does not fit into memory");
    else
        base_fail(error, path, "is not valid JSON: line %d, column %d: %s%s", wrong.line,
                  wrong.column, wrong.text, explain(text, size, wrong.position));
    return NULL;
}

json_t *file_read_json(const char *path, size_t limit, base_error *error) {
    void *data;
    size_t size;
    if (!file_read(path, limit, &data, &size, error))
        return NULL;
    json_t *root = file_parse_json(path, data, size, error);
    free(data);
    return root;
}

/* --- values ----------------------------------------------------------------------------------- */

bool file_json_number(const json_t *item, double minimum, double maximum, double *number) {
    const double value = json_number_value(item);
    if (!json_is_number(item) || !(value >= minimum && value <= maximum))
        return false;
    *number = value;
    return true;
}

bool file_json_numbers(const json_t *item, size_t count, double minimum, double maximum,
                       double *numbers) {
    bool ok = json_is_array(item) && json_array_size(item) == count;
    for (size_t i = 0; ok && i < count; i++)
        ok = file_json_number(json_array_get(item, i), minimum, maximum, &numbers[i]);
    return ok;
}

const char *file_json_unknown_key(json_t *object, const char *const *known) {
    const char *key;
    json_t *value;
    json_object_foreach (object, key, value) {
        size_t i = 0;
        while (known[i] && strcmp(known[i], key) != 0)
            i++;
        if (!known[i])
            return key;
    }
    return NULL;
}

json_t *file_json_list(const char *path, const json_t *root, const char *name, base_error *error) {
    json_t *list = json_object_get(root, name);
    if (!json_is_array(list))
        base_fail(error, path, "has no array \"%s\"", name);
    else if (json_object_size(root) != 1)
        base_fail(error, path, "has keys other than \"%s\"", name);
    else
        return list;
    return NULL;
}
