/* SPDX-License-Identifier: MIT */
/* cjson.c - what reading a scene needs of cJSON, which Debian has for the machine's own
 * architecture alone. Texts come here after file_json_wrong: they are valid, and nested 1000 deep
 * at most. */
#include <cjson/cJSON.h>

#include <stdlib.h>
#include <string.h>

static cJSON_Hooks memory = { malloc, free };

void cJSON_InitHooks(cJSON_Hooks *hooks) {
    memory = *hooks;
}

/* --- values ----------------------------------------------------------------------------------- */

cJSON_bool cJSON_IsArray(const cJSON *item) {
    return item && item->type == cJSON_Array;
}
cJSON_bool cJSON_IsBool(const cJSON *item) {
    return item && (item->type & (cJSON_True | cJSON_False)) != 0;
}
cJSON_bool cJSON_IsNumber(const cJSON *item) {
    return item && item->type == cJSON_Number;
}
cJSON_bool cJSON_IsObject(const cJSON *item) {
    return item && item->type == cJSON_Object;
}
cJSON_bool cJSON_IsString(const cJSON *item) {
    return item && item->type == cJSON_String;
}
cJSON_bool cJSON_IsTrue(const cJSON *item) {
    return item && item->type == cJSON_True;
}

int cJSON_GetArraySize(const cJSON *array) {
    int size = 0;
    for (const cJSON *item = array ? array->child : NULL; item; item = item->next)
        size++;
    return size;
}

cJSON *cJSON_GetArrayItem(const cJSON *array, int index) {
    cJSON *item = array ? array->child : NULL;
    for (; item && index > 0; index--)
        item = item->next;
    return index == 0 ? item : NULL;
}

cJSON *cJSON_GetObjectItemCaseSensitive(const cJSON *object, const char *name) {
    cJSON *item = object ? object->child : NULL;
    while (item && strcmp(item->string, name) != 0)
        item = item->next;
    return item;
}

cJSON *cJSON_DetachItemViaPointer(cJSON *parent, cJSON *item) {
    for (cJSON **link = &parent->child; *link; link = &(*link)->next)
        if (*link == item) {
            *link = item->next;
            item->next = NULL;
            return item;
        }
    return NULL;
}

void cJSON_Delete(cJSON *item) {
    while (item) {
        cJSON *const next = item->next;
        cJSON_Delete(item->child);
        memory.free_fn(item->valuestring);
        memory.free_fn(item->string);
        memory.free_fn(item);
        item = next;
    }
}

/* --- parsing ---------------------------------------------------------------------------------- */

static void skip(const char **at) {
    *at += strspn(*at, " \t\r\n");
}

/* The four digits of \uXXXX. */
static unsigned long code_unit(const char *at) {
    const char digits[5] = { at[0], at[1], at[2], at[3], 0 };
    return strtoul(digits, NULL, 16);
}

/* A character of an escape whose letter *at is; writes its UTF-8. */
static char *unescape(const char **at, char *to) {
    static const char letters[] = "bfnrt", meanings[] = "\b\f\n\r\t";
    const char *const letter = strchr(letters, **at);
    if (**at != 'u') {
        *to++ = letter ? meanings[letter - letters] : **at;
        *at += 1;
        return to;
    }
    unsigned long c = code_unit(*at + 1);
    *at += 5;
    if (c >= 0xD800 && c < 0xDC00 && (*at)[0] == '\\' && (*at)[1] == 'u') {
        c = 0x10000 + ((c & 0x3FF) << 10) + (code_unit(*at + 2) & 0x3FF);
        *at += 6;
    }
    const int more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    static const unsigned char marks[] = { 0, 0xC0, 0xE0, 0xF0 };
    *to++ = (char)(marks[more] | c >> 6 * more);
    for (int i = more - 1; i >= 0; i--)
        *to++ = (char)(0x80 | (c >> 6 * i & 0x3F));
    return to;
}

static char *parse_string(const char **at) {
    const char *end = ++*at; /* escapes are longer than what they mean */
    while (*end != '"')
        end += *end == '\\' ? 2 : 1;
    char *const text = memory.malloc_fn((size_t)(end - *at) + 1), *to = text;
    while (text && *at < end)
        if (**at == '\\') {
            ++*at;
            to = unescape(at, to);
        } else {
            *to++ = *(*at)++;
        }
    if (text)
        *to = 0;
    *at = end + 1;
    return text;
}

static double parse_number(const char **at) {
    char *end;
    const double number = strtod(*at, &end);
    *at = end;
    return number;
}

static cJSON *parse_value(const char **at);

/* The members of an object or the items of an array; NULL without memory, or if there are none. */
static cJSON *parse_list(const char **at, int type) {
    const char end = type == cJSON_Object ? '}' : ']';
    cJSON *first = NULL, **link = &first;
    do {
        ++*at; /* the bracket, or a comma */
        skip(at);
        if (**at == end)
            break;
        char *const name = type == cJSON_Object ? parse_string(at) : NULL;
        *at += strspn(*at, " \t\r\n:");
        cJSON *const item = parse_value(at);
        skip(at);
        if (!item || (type == cJSON_Object && !name)) {
            memory.free_fn(name);
            cJSON_Delete(item);
            break;
        }
        item->string = name;
        *link = item;
        link = &item->next;
    } while (**at == ',');
    *at += **at == end;
    return first;
}

static cJSON *parse_value(const char **at) {
    skip(at);
    cJSON *const item = memory.malloc_fn(sizeof *item);
    if (!item)
        return NULL;
    *item = (cJSON) { .type = **at == '{'   ? cJSON_Object
                              : **at == '[' ? cJSON_Array
                              : **at == '"' ? cJSON_String
                              : **at == 't' ? cJSON_True
                              : **at == 'f' ? cJSON_False
                              : **at == 'n' ? cJSON_NULL
                                            : cJSON_Number };
    if (item->type == cJSON_Object || item->type == cJSON_Array)
        item->child = parse_list(at, item->type);
    else if (item->type == cJSON_String)
        item->valuestring = parse_string(at);
    else if (item->type == cJSON_Number)
        item->valuedouble = parse_number(at);
    else
        *at += item->type == cJSON_False ? 5 : 4;
    return item;
}

cJSON *cJSON_ParseWithLength(const char *text, size_t size) {
    char *const copy = memory.malloc_fn(size + 1); /* with an end */
    if (!copy)
        return NULL;
    memcpy(copy, text, size);
    copy[size] = 0;
    const char *at = copy;
    cJSON *const root = parse_value(&at);
    memory.free_fn(copy);
    return root;
}
