/* SPDX-License-Identifier: MIT */
#include "app/scene/shot.h"

#include "app/image/image.h"

#include <stdlib.h>
#include <string.h>

bool shot_has_name(const char *path) {
    return image_format_of(path) == IMAGE_PNG;
}

json_t *shot_read(const char *path, base_error *error) {
    char *text = NULL;
    if (!image_read_png_text(path, SHOT_KEY, &text, error))
        return NULL;
    json_t *root = file_parse_json(path, text, strlen(text), error);
    free(text);
    return root;
}
