/* SPDX-License-Identifier: MIT */
#include "app/file/file.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

struct cJSON *file_parse_json(const char *path, const char *text, size_t size, cli_error *error) {
    const char *stop = text;
    cJSON *root = cJSON_ParseWithLengthOpts(text, size + 1, &stop, true);
    if (root && strlen(text) == size)
        return root;
    int line = 1;
    for (const char *at = text; at < stop && *at; at++)
        line += *at == '\n';
    cli_fail(error, path, "is no valid JSON: line %d", line);
    cJSON_Delete(root);
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
