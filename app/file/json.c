/* SPDX-License-Identifier: MIT */
#include "app/cli/printable.h"
#include "app/file/file.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* cJSON goes on without what it has no memory for, and says nothing: its allocator remembers. */
static _Thread_local bool out_of_memory;

static void *allocate(size_t size) {
    void *const memory = malloc(size);
    out_of_memory = out_of_memory || !memory;
    return memory;
}

__attribute__((constructor)) static void watch_memory(void) {
    cJSON_InitHooks(&(cJSON_Hooks) { allocate, free });
}

/* Whether memory ran out since the last call. */
static bool ran_out(void) {
    const bool failed = out_of_memory;
    out_of_memory = false;
    return failed;
}

char *file_json_text(struct cJSON *root, bool lines, const char *subject, cli_error *error) {
    char *text = lines ? cJSON_Print(root) : cJSON_PrintUnformatted(root);
    cJSON_Delete(root);
    if (!ran_out() && text)
        return text;
    free(text);
    cli_fail(error, subject, "out of memory");
    return NULL;
}

bool file_json_print(struct cJSON *root, const char *subject, cli_error *error) {
    char *const text = file_json_text(root, true, subject, error);
    for (const char *at = text; at && *at;) {
        uint32_t code;
        const size_t length = cli_character(at, &code);
        if (cli_printable(at) || *at == '\n' || *at == '\t')
            fwrite(at, 1, length, stdout);
        else
            printf("\\u%04x", length ? (unsigned)code : 0xFFFDu);
        at += length ? length : 1;
    }
    if (text)
        putchar('\n');
    free(text);
    return text != NULL;
}

struct cJSON *file_parse_json(const char *path, const char *text, size_t size, cli_error *error) {
    const char *wrong = file_json_wrong(text, size);
    if (wrong) {
        int line = 1, column = 1;
        for (const char *at = text; at < wrong; at++) {
            line += *at == '\n';
            column = *at == '\n' ? 1 : column + 1;
        }
        cli_fail(error, path, "is not valid JSON: line %d, column %d: %s", line, column,
                 file_json_cause(text, size, wrong));
        return NULL;
    }
    cJSON *root = cJSON_ParseWithLength(text, size);
    if (!ran_out() && root)
        return root;
    cJSON_Delete(root);
    cli_fail(error, path, "is JSON that does not fit into memory");
    return NULL;
}

struct cJSON *file_read_json(const char *path, size_t limit, cli_error *error) {
    void *data;
    size_t size;
    if (!file_read(path, limit, &data, &size, error))
        return NULL;
    cJSON *root = file_parse_json(path, data, size, error);
    free(data);
    return root;
}

const struct cJSON *file_json_member(const struct cJSON *object, const char *name) {
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

bool file_json_number(const struct cJSON *item, double minimum, double maximum, double *number) {
    if (!cJSON_IsNumber(item) || !(item->valuedouble >= minimum && item->valuedouble <= maximum))
        return false;
    *number = item->valuedouble;
    return true;
}

bool file_json_numbers(const struct cJSON *item, int count, double minimum, double maximum,
                       double *numbers) {
    if (!cJSON_IsArray(item) || cJSON_GetArraySize(item) != count)
        return false;
    const cJSON *entry;
    cJSON_ArrayForEach(entry, item) {
        if (!file_json_number(entry, minimum, maximum, numbers++))
            return false;
    }
    return true;
}

static cJSON *number_of(float number) {
    char text[32];
    snprintf(text, sizeof text, "%.9g", (double)number);
    return cJSON_CreateRaw(text);
}

void file_json_add_floats(struct cJSON *object, const char *name, const float *numbers, int count) {
    if (count == 1) {
        cJSON_AddItemToObject(object, name, number_of(*numbers));
        return;
    }
    cJSON *array = cJSON_AddArrayToObject(object, name);
    for (int i = 0; i < count; i++)
        cJSON_AddItemToArray(array, number_of(numbers[i]));
}

const char *file_json_unknown_key(const struct cJSON *object, const char *const *known) {
    for (const cJSON *item = object->child; item; item = item->next) {
        size_t i = 0;
        while (known[i] && strcmp(known[i], item->string) != 0)
            i++;
        if (!known[i])
            return item->string;
    }
    return NULL;
}

const char *file_json_repeated_key(const struct cJSON *object) {
    for (const cJSON *item = object->child; item; item = item->next)
        for (const cJSON *other = item->next; other; other = other->next)
            if (strcmp(item->string, other->string) == 0)
                return item->string;
    return NULL;
}

const struct cJSON *file_json_list(const char *path, const struct cJSON *root, const char *name,
                                   cli_error *error) {
    const cJSON *list = cJSON_IsObject(root) ? file_json_member(root, name) : NULL;
    if (!cJSON_IsArray(list))
        cli_fail(error, path, "has no array \"%s\"", name);
    else if (cJSON_GetArraySize(root) != 1)
        cli_fail(error, path, "has keys other than \"%s\"", name);
    else
        return list;
    return NULL;
}
