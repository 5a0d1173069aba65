/* SPDX-License-Identifier: MIT */
/* load.h - a scene that a test needs, read anew. */
#ifndef LAMPION_PROGRAM_LOAD_H
#define LAMPION_PROGRAM_LOAD_H

#include "app/scene/scene.h"
#include "tests/oracle/check.h"

static inline scene load(const char *name) {
    scene loaded;
    cli_error error = { 0 };
    if (!scene_load(name, &(scene_options) { .no_cache = true }, &loaded, &error))
        fail_msg("%s", error.text);
    return loaded;
}

#endif
