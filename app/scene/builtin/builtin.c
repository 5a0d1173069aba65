/* SPDX-License-Identifier: MIT */
#include "app/scene/builtin/builtin.h"
#include "app/base/choice.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TILES_MAX 64

typedef struct builtin_scene {
    const char *name;
    void (*make)(const builtin_parameters *parameters, scene_builder *builder);
    int lanterns; /* default number; 0: the scene does not take this parameter */
    bool tiled;
} builtin_scene;

static const builtin_scene builtin_scenes[] = {
    { "atrium", builtin_atrium, 30, true },
    { "balls", builtin_balls, 0, false },
    { "ball", builtin_ball, 0, false },
    { "room", builtin_room, 0, false },
};
#define BUILTIN_SCENES (sizeof builtin_scenes / sizeof *builtin_scenes)

const char *scene_builtin_name(size_t i) {
    return i < BUILTIN_SCENES ? builtin_scenes[i].name : NULL;
}

static bool unknown_scene(const char *name, base_error *error) {
    const char *names[BUILTIN_SCENES + 1] = { NULL };
    char word[64];
    for (size_t i = 0; i < BUILTIN_SCENES; i++)
        names[i] = builtin_scenes[i].name;
    snprintf(word, sizeof word, "%.*s", (int)strcspn(name, ":"), name);
    return choice_fail(error, "builtin", word, names);
}

static bool parse_number(const char *text, size_t length, uint64_t maximum, uint64_t *number) {
    char digits[24];
    if (length == 0 || length >= sizeof digits || strspn(text, "0123456789") < length)
        return false;
    memcpy(digits, text, length);
    digits[length] = 0;
    errno = 0;
    *number = strtoull(digits, NULL, 10);
    return errno == 0 && *number <= maximum;
}

/* Reads "key=value" of `length` bytes. */
static bool parse_parameter(const builtin_scene *which, const char *text, size_t length,
                            builtin_parameters *parameters, base_error *error) {
    const char *equals = memchr(text, '=', length);
    const size_t key = equals ? (size_t)(equals - text) : length;
    const char *value = equals ? equals + 1 : text + length;
    const size_t value_length = length - (size_t)(value - text);
    uint64_t number = 0;
    if (key == 8 && memcmp(text, "lanterns", key) == 0 && which->lanterns > 0) {
        if (!parse_number(value, value_length, SCENE_LIGHTS_MAX, &number))
            return base_fail(error, which->name, "lanterns must be a whole number from 0 to %d",
                             SCENE_LIGHTS_MAX);
        parameters->lanterns = (int)number;
    } else if (key == 5 && memcmp(text, "tiles", key) == 0 && which->tiled) {
        if (!parse_number(value, value_length, TILES_MAX, &number) || number == 0)
            return base_fail(error, which->name, "tiles must be a whole number from 1 to %d",
                             TILES_MAX);
        parameters->tiles = (int)number;
    } else if (key == 6 && memcmp(text, "detail", key) == 0 && which->tiled) {
        if (!parse_number(value, value_length, 100, &number) || number == 0)
            return base_fail(error, which->name, "detail must be a whole number from 1 to 100");
        parameters->detail = (int)number;
    } else if (key == 4 && memcmp(text, "seed", key) == 0 && which->lanterns > 0) {
        if (!parse_number(value, value_length, UINT64_MAX, &parameters->seed))
            return base_fail(error, which->name, "seed must be a whole number");
    } else {
        return base_fail(error, which->name, "has no parameter \"%.*s\" (%s)", (int)key, text,
                         which->lanterns > 0 ? "there are lanterns, tiles, detail, seed"
                                             : "there are none");
    }
    return true;
}

bool builtin_make(const char *name, scene_builder *builder, base_error *error) {
    const size_t name_length = strcspn(name, ":");
    for (size_t i = 0; i < BUILTIN_SCENES; i++) {
        const builtin_scene *which = &builtin_scenes[i];
        if (strlen(which->name) != name_length || memcmp(name, which->name, name_length) != 0)
            continue;
        builtin_parameters parameters = { which->lanterns, 1, 100, 1 };
        const char *text = name + name_length;
        while (*text) {
            text++;
            const size_t length = strcspn(text, ",");
            if (!parse_parameter(which, text, length, &parameters, error))
                return false;
            text += length;
        }
        which->make(&parameters, builder);
        return true;
    }
    return unknown_scene(name, error);
}
