/* SPDX-License-Identifier: MIT */
/* file_json_write.c - writing JSON. */
#include "app/base/file_json.h"
#include "app/base/printable.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- values ----------------------------------------------------------------------------------- */

json_t *file_json_string(const char *text) {
    static const char replacement[] = "\uFFFD";
    char *const valid = malloc(strlen(text) * strlen(replacement) + 1), *to = valid;
    while (valid && *text) {
        uint32_t code;
        const size_t length = printable_character(text, &code);
        const char *from = length ? text : replacement;
        const size_t size = length ? length : strlen(replacement);
        memcpy(to, from, size);
        to += size;
        text += length ? length : 1;
    }
    json_t *const string = valid ? json_stringn(valid, (size_t)(to - valid)) : NULL;
    free(valid);
    return string;
}

json_t *file_json_real(double number) {
    return isfinite(number) ? json_real(number) : json_null();
}

json_t *file_json_float(float number) {
    enum { EXACT = 9 }; /* FLT_DECIMAL_DIG: digits that distinguish all floats */
    char text[32];
    int digits = 1;
    do
        snprintf(text, sizeof text, "%.*g", digits, (double)number);
    while ((float)strtod(text, NULL) != number && digits++ < EXACT);
    return file_json_real(strtod(text, NULL));
}

json_t *file_json_floats(const float *numbers, size_t count) {
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        array = file_json_append(array, file_json_float(numbers[i]));
    return array;
}

json_t *file_json_with(json_t *object, const char *name, json_t *value) {
    if (json_object_set_new(object, name, value) == 0)
        return object;
    json_decref(object);
    return NULL;
}

json_t *file_json_append(json_t *array, json_t *value) {
    if (json_array_append_new(array, value) == 0)
        return array;
    json_decref(array);
    return NULL;
}

/* --- texts ------------------------------------------------------------------------------------ */

/* Copies the string at *at, which is moved past it, to `to`, which must not lie beyond it; returns
 * the end of the copy. */
static char *copy_string(char *to, const char **at) {
    do {
        if (**at == '\\')
            *to++ = *(*at)++;
        *to++ = *(*at)++;
    } while (**at != '"');
    *to++ = *(*at)++;
    return to;
}

/* Copies a number as copy_string copies a string, but with fewer digits than jansson's 17 if they
 * read back as the same number. */
static char *copy_number(char *to, const char **at) {
    enum { SURE = 15, EXACT = 17 }; /* DBL_DIG and DBL_DECIMAL_DIG */
    const char *from = *at;
    size_t length = strspn(from, "0123456789+-.e");
    const bool real = strcspn(from, ".e") < length;
    char text[32];
    *at += length;
    for (int digits = SURE; real && digits < EXACT; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, strtod(from, NULL));
        if (strlen(text) < length && strtod(text, NULL) == strtod(from, NULL)) {
            from = text;
            length = strlen(text);
            break;
        }
    }
    memmove(to, from, length);
    return to + length;
}

/* Whether the array that begins at `at` contains no string, array or object. */
static bool is_flat(const char *at) {
    return at[1 + strcspn(at + 1, "[]{\"")] == ']';
}

/* Shortens numbers and puts each array of numbers on one line. */
static void tidy(char *text) {
    char *to = text;
    bool flat = false;
    for (const char *at = text; *at;) {
        if (*at == '"') {
            to = copy_string(to, &at);
        } else if (*at == '-' || (*at >= '0' && *at <= '9')) {
            to = copy_number(to, &at);
        } else if (flat && *at == '\n') {
            at += strspn(at, "\n ");
            if (to[-1] == ',')
                *to++ = ' ';
        } else {
            flat = *at == '[' ? is_flat(at) : flat && *at != ']';
            *to++ = *at++;
        }
    }
    *to = '\0';
}

char *file_json_text(json_t *root, bool lines, const char *subject, base_error *error) {
    char *const text =
        root ? file_json_dump(root, JSON_ENCODE_ANY | (lines ? JSON_INDENT(2) : JSON_COMPACT))
             : NULL;
    json_decref(root);
    if (text)
        tidy(text);
    else
        base_fail(error, subject, "out of memory");
    return text;
}

bool file_json_print(json_t *root, const char *subject, base_error *error) {
    char *const text = file_json_text(root, true, subject, error);
    for (const char *at = text; at && *at;) {
        uint32_t code;
        const size_t length = printable_character(at, &code);
        if (printable_length(at) || *at == '\n')
            fwrite(at, 1, length, stdout);
        else
            printf("\\u%04X", (unsigned)code);
        at += length;
    }
    if (text)
        putchar('\n');
    free(text);
    return text != NULL;
}
