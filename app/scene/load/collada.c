/* SPDX-License-Identifier: MIT */
#include "app/scene/load/collada.h"

#include <stdlib.h>
#include <string.h>

typedef struct span {
    const char *at, *end;
} span;

typedef struct array {
    span id;
    double count;
} array;

typedef struct arrays {
    array *items;
    size_t count, capacity;
} arrays;

/* Finds the next tag that begins with the name, from *at on; *tag is the text between the name and
 * the closing bracket. */
static bool find_tag(const char **at, const char *end, const char *name, span *tag) {
    const size_t length = strlen(name);
    const char *const found = memmem(*at, (size_t)(end - *at), name, length);
    if (!found)
        return false;
    const char *const close = memchr(found, '>', (size_t)(end - found));
    *at = close ? close : end;
    *tag = (span) { found + length, *at };
    return true;
}

/* Finds the value of an attribute, before whose name there is a blank. */
static bool find_attribute(span tag, const char *name, span *value) {
    const size_t length = strlen(name);
    for (const char *at = tag.at; at < tag.end; at++) {
        at = memmem(at, (size_t)(tag.end - at), name, length);
        if (!at)
            return false;
        const char *quote = at + length;
        while (quote < tag.end && strchr(" \t\r\n", *quote) && *quote)
            quote++;
        if (at == tag.at || !strchr(" \t\r\n", at[-1]) || quote == tag.end || *quote != '=')
            continue;
        for (quote++; quote < tag.end && strchr(" \t\r\n", *quote) && *quote;)
            quote++;
        const char *const close =
            quote < tag.end ? memchr(quote + 1, *quote, (size_t)(tag.end - quote - 1)) : NULL;
        if (!close)
            return false;
        *value = (span) { quote + 1, close };
        return true;
    }
    return false;
}

/* Reads a whole number; returns the fallback if there is none, and a huge number if it is not a
 * whole number. */
static double number_of(span tag, const char *name, double fallback) {
    span value;
    double sum = 0.0;
    if (!find_attribute(tag, name, &value))
        return fallback;
    for (const char *at = value.at; at < value.end; at++)
        sum = *at >= '0' && *at <= '9' ? 10.0 * sum + (double)(*at - '0') : 1e300;
    return sum;
}

static bool add_array(arrays *list, span tag) {
    if (list->count == list->capacity) {
        const size_t capacity = 2 * list->capacity + 64;
        array *const items = realloc(list->items, capacity * sizeof *items);
        if (!items)
            return false;
        list->items = items;
        list->capacity = capacity;
    }
    array *const item = &list->items[list->count];
    item->count = number_of(tag, "count", 0.0);
    list->count += find_attribute(tag, "id", &item->id);
    return true;
}

static bool find_arrays(const char *text, const char *end, arrays *list) {
    static const char *const names[] = { "<float_array", "<int_array", "<Name_array",
                                         "<IDREF_array" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        span tag;
        for (const char *at = text; find_tag(&at, end, names[i], &tag);)
            if (!add_array(list, tag))
                return false;
    }
    return true;
}

/* Finds the array with that id, first at *near: mostly it is the one before. Returns NULL where
 * Assimp does not find it either. */
static const array *array_of(const arrays *list, span id, size_t *near) {
    for (size_t i = 0; i < list->count; i++) {
        const array *const item = &list->items[(*near + i) % list->count];
        const size_t length = (size_t)(item->id.end - item->id.at);
        if (length == (size_t)(id.end - id.at) && memcmp(item->id.at, id.at, length) == 0) {
            *near = (*near + i) % list->count;
            return item;
        }
    }
    return NULL;
}

/* Counts the parameters after an accessor's tag; each reads one number from the offset on, whatever
 * the stride. */
static double parameters_after(const char *at, const char *end) {
    const char *const close = memmem(at, (size_t)(end - at), "</accessor", 10);
    double count = 0.0;
    span tag;
    while (close && find_tag(&at, close, "<param", &tag))
        count++;
    return count;
}

bool collada_check(const char *text, size_t size, const char *subject, base_error *error) {
    const char *const end = text + size;
    arrays list = { NULL, 0, 0 };
    span tag, source;
    size_t near = 0;
    bool ok =
        find_arrays(text, end, &list) || base_fail(error, subject, "does not fit into memory");
    for (const char *at = text; ok && find_tag(&at, end, "<accessor", &tag);) {
        if (!find_attribute(tag, "source", &source) || source.at == source.end)
            continue;
        source.at += *source.at == '#';
        const array *const of = array_of(&list, source, &near);
        const double count = number_of(tag, "count", 0.0), stride = number_of(tag, "stride", 1.0);
        const double parameters = parameters_after(at, end);
        if (of && count > 0.0 &&
            number_of(tag, "offset", 0.0) + (count - 1.0) * stride +
                    (stride > parameters ? stride : parameters) >
                of->count)
            ok = base_fail(error, subject,
                           "is not valid COLLADA: an accessor reaches past its array, \"%.*s\"",
                           (int)(source.end - source.at < 64 ? source.end - source.at : 64),
                           source.at);
    }
    free(list.items);
    return ok;
}
