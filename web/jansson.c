/* SPDX-License-Identifier: MIT */
/* jansson.c - the part of jansson that reads a scene, which Debian has only for the machine's own
 * architecture: its parser, as strict and as deep, and the functions that take values apart. */
#include "app/base/file_json.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEPTH_MAX 2048 /* arrays and objects nested in one another */

typedef struct member {
    struct member *next;
    json_t *value;
    char name[]; /* empty in an array */
} member;

/* Only the members of the value's type are used. */
typedef struct value {
    json_t json;
    double number;
    char *text;
    member *first, *last;
    member **items; /* of an array, set once it is read */
    size_t count;
} value;

/* --- values ----------------------------------------------------------------------------------- */

static const value *value_of(const json_t *json, json_type type) {
    return json && json_typeof(json) == type ? (const value *)json : NULL;
}

size_t json_array_size(const json_t *array) {
    const value *v = value_of(array, JSON_ARRAY);
    return v ? v->count : 0;
}

json_t *json_array_get(const json_t *array, size_t index) {
    const value *v = value_of(array, JSON_ARRAY);
    return v && index < v->count ? v->items[index]->value : NULL;
}

size_t json_object_size(const json_t *object) {
    const value *v = value_of(object, JSON_OBJECT);
    return v ? v->count : 0;
}

json_t *json_object_get(const json_t *object, const char *name) {
    const value *v = value_of(object, JSON_OBJECT);
    const member *m = v ? v->first : NULL;
    while (m && strcmp(m->name, name) != 0)
        m = m->next;
    return m ? m->value : NULL;
}

const char *json_string_value(const json_t *string) {
    const value *v = value_of(string, JSON_STRING);
    return v ? v->text : NULL;
}

double json_number_value(const json_t *number) {
    const value *v = value_of(number, JSON_REAL);
    return v ? v->number : 0.0;
}

int json_real_set(json_t *number, double to) {
    if (!value_of(number, JSON_REAL))
        return -1;
    ((value *)number)->number = to;
    return 0;
}

void *json_object_iter(json_t *object) {
    const value *v = value_of(object, JSON_OBJECT);
    return v ? v->first : NULL;
}

void *json_object_iter_next(json_t *object, void *iter) {
    (void)object;
    return iter ? ((member *)iter)->next : NULL;
}

const char *json_object_iter_key(void *iter) {
    return iter ? ((member *)iter)->name : NULL;
}

json_t *json_object_iter_value(void *iter) {
    return iter ? ((member *)iter)->value : NULL;
}

void *json_object_key_to_iter(const char *key) {
    return key ? (void *)((uintptr_t)key - offsetof(member, name)) : NULL;
}

static void free_member(member *m) {
    json_decref(m->value);
    free(m);
}

int json_object_del(json_t *object, const char *name) {
    value *v = (value *)object;
    for (member **link = &v->first; *link; link = &(*link)->next)
        if (strcmp((*link)->name, name) == 0) {
            member *const found = *link;
            *link = found->next;
            v->count--;
            free_member(found);
            return 0;
        }
    return -1;
}

void json_delete(json_t *json) {
    value *v = (value *)json;
    for (member *m = v->first, *next; m; m = next) {
        next = m->next;
        free_member(m);
    }
    free(v->items);
    free(v->text);
    free(v);
}

/* --- parsing ---------------------------------------------------------------------------------- */

typedef struct parser {
    const char *at; /* a NUL, which is not a character of JSON, ends it */
    int depth;
    bool out_of_memory;
} parser;

static bool take(parser *p, char c) {
    if (*p->at != c)
        return false;
    p->at++;
    return true;
}

static void skip_space(parser *p) {
    p->at += strspn(p->at, " \t\r\n");
}

static bool skip_digits(parser *p) {
    const size_t count = strspn(p->at, "0123456789");
    p->at += count;
    return count > 0;
}

static void *allocate(parser *p, size_t size) {
    void *const memory = malloc(size);
    p->out_of_memory |= !memory;
    return memory;
}

/* Reads the four digits of \uXXXX; returns 0, which no text may hold, if they are not valid. */
static unsigned long take_code_unit(parser *p) {
    unsigned long unit = 0;
    for (int i = 0; i < 4; i++, p->at++) {
        static const char digits[] = "0123456789abcdefABCDEF";
        const char *const digit = *p->at ? strchr(digits, *p->at) : NULL;
        if (!digit)
            return 0;
        unit = unit << 4 | (unsigned long)(digit - digits - (digit - digits > 15 ? 6 : 0));
    }
    return unit;
}

/* Appends the character that follows \u as UTF-8; returns NULL if it is not valid. */
static char *take_unicode(parser *p, char *to) {
    unsigned long c = take_code_unit(p);
    if (c >= 0xD800 && c < 0xDC00) {
        const unsigned long low = take(p, '\\') && take(p, 'u') ? take_code_unit(p) : 0;
        c = low >= 0xDC00 && low < 0xE000 ? 0x10000 + ((c & 0x3FF) << 10) + (low & 0x3FF) : 0;
    } else if (c >= 0xDC00 && c < 0xE000) {
        c = 0;
    }
    static const unsigned char marks[] = { 0, 0xC0, 0xE0, 0xF0 };
    const int more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    *to++ = (char)(marks[more] | c >> 6 * more);
    for (int i = more - 1; i >= 0; i--)
        *to++ = (char)(0x80 | (c >> 6 * i & 0x3F));
    return c ? to : NULL;
}

static char *take_escape(parser *p, char *to) {
    static const char letters[] = "\"\\/bfnrt", meanings[] = "\"\\/\b\f\n\r\t";
    const char *const letter = *p->at ? strchr(letters, *p->at) : NULL;
    if (take(p, 'u'))
        return take_unicode(p, to);
    if (!letter)
        return NULL;
    *to++ = meanings[letter - letters];
    p->at++;
    return to;
}

/* Reads a string; returns NULL if it is not valid, or without memory. Escapes are longer than what
 * they encode. */
static char *take_string(parser *p) {
    if (!take(p, '"'))
        return NULL;
    size_t room = 1;
    for (const char *end = p->at; *end && *end != '"'; end += end[0] == '\\' && end[1] ? 2 : 1)
        room += 2;
    char *const text = allocate(p, room), *to = text;
    while (to && *p->at != '"') {
        if ((unsigned char)*p->at < 0x20)
            to = NULL;
        else if (take(p, '\\'))
            to = take_escape(p, to);
        else
            *to++ = *p->at++;
    }
    if (!to) {
        free(text);
        return NULL;
    }
    *to = '\0';
    p->at++;
    return text;
}

static bool take_number(parser *p, double *number) {
    const char *const first = p->at;
    take(p, '-');
    if (!take(p, '0') && !skip_digits(p))
        return false;
    if (take(p, '.') && !skip_digits(p))
        return false;
    if (take(p, 'e') || take(p, 'E')) {
        if (!take(p, '+'))
            take(p, '-');
        if (!skip_digits(p))
            return false;
    }
    *number = strtod(first, NULL);
    return isfinite(*number);
}

static bool take_word(parser *p, const char *word) {
    const bool is_there = strncmp(p->at, word, strlen(word)) == 0;
    p->at += is_there ? strlen(word) : 0;
    return is_there;
}

static json_t *take_value(parser *p);

/* Adds a member and takes its value over; name is NULL in an array. */
static bool add_member(parser *p, value *v, const char *name, json_t *of) {
    const size_t length = name ? strlen(name) : 0;
    member *const m = of && !(name && json_object_get(&v->json, name))
                          ? allocate(p, sizeof *m + length + 1)
                          : NULL;
    if (!m) {
        json_decref(of);
        return false;
    }
    m->next = NULL;
    m->value = of;
    memcpy(m->name, name ? name : "", length + 1);
    *(v->last ? &v->last->next : &v->first) = m;
    v->last = m;
    v->count++;
    return true;
}

static bool take_member(parser *p, value *v) {
    char *name = NULL;
    if (v->json.type == JSON_OBJECT) {
        skip_space(p);
        name = take_string(p);
        skip_space(p);
        if (!name || !take(p, ':')) {
            free(name);
            return false;
        }
    }
    const bool ok = add_member(p, v, name, take_value(p));
    free(name);
    return ok;
}

static bool take_members(parser *p, value *v, char end) {
    p->at++;
    skip_space(p);
    if (take(p, end))
        return true;
    do {
        if (!take_member(p, v))
            return false;
    } while (take(p, ','));
    if (!take(p, end))
        return false;
    v->items = v->json.type == JSON_ARRAY ? allocate(p, v->count * sizeof(member *)) : NULL;
    size_t i = 0;
    for (member *m = v->first; v->items && m; m = m->next)
        v->items[i++] = m;
    return v->json.type != JSON_ARRAY || v->items;
}

static bool fill(parser *p, value *v) {
    switch (v->json.type) {
    case JSON_OBJECT:
        return take_members(p, v, '}');
    case JSON_ARRAY:
        return take_members(p, v, ']');
    case JSON_STRING:
        v->text = take_string(p);
        return v->text;
    case JSON_TRUE:
        return take_word(p, "true");
    case JSON_FALSE:
        return take_word(p, "false");
    case JSON_NULL:
        return take_word(p, "null");
    default:
        return take_number(p, &v->number);
    }
}

/* Reads a value with the space around it. */
static json_t *take_value(parser *p) {
    skip_space(p);
    value *const v = p->depth < DEPTH_MAX ? allocate(p, sizeof *v) : NULL;
    if (!v)
        return NULL;
    *v = (value) { .json = { .type = *p->at == '{'   ? JSON_OBJECT
                                     : *p->at == '[' ? JSON_ARRAY
                                     : *p->at == '"' ? JSON_STRING
                                     : *p->at == 't' ? JSON_TRUE
                                     : *p->at == 'f' ? JSON_FALSE
                                     : *p->at == 'n' ? JSON_NULL
                                                     : JSON_REAL,
                             .refcount = 1 } };
    p->depth++;
    const bool ok = fill(p, v);
    p->depth--;
    skip_space(p);
    if (ok)
        return &v->json;
    json_delete(&v->json);
    return NULL;
}

/* Reports where a text stops being JSON. */
static void explain(const char *text, size_t size, size_t end, json_error_t *error) {
    *error =
        (json_error_t) { .line = 1, .column = 1, .position = (int)(end < size ? end + 1 : size) };
    for (size_t i = 0; i < end; i++) {
        error->line += text[i] == '\n';
        error->column = text[i] == '\n' ? 1 : error->column + 1;
    }
    snprintf(error->text, sizeof error->text, "a value, name, comma or bracket is wrong here");
}

json_t *file_json_load(const char *text, size_t size, json_error_t *error) {
    char *const copy = malloc(size + 1); /* with a terminating NUL */
    parser p = { .at = copy, .out_of_memory = !copy };
    json_t *root = NULL;
    if (copy) {
        memcpy(copy, text, size);
        copy[size] = '\0';
        root = take_value(&p);
    }
    if (root && p.at != copy + size) {
        json_decref(root);
        root = NULL;
    }
    *error = (json_error_t) { .line = 0 };
    if (!root && !p.out_of_memory)
        explain(copy, size, (size_t)(p.at - copy), error);
    error->text[JSON_ERROR_TEXT_LENGTH - 1] =
        p.out_of_memory ? json_error_out_of_memory : json_error_invalid_syntax;
    free(copy);
    return root;
}
