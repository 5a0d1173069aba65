/* SPDX-License-Identifier: MIT */
/* surroundings.h - the environment of the settings that were drawn last. */
#ifndef LAMPION_VIEW_SURROUNDINGS_H
#define LAMPION_VIEW_SURROUNDINGS_H

#include "app/view/settings.h"

/* Zero is none; environment_free(&around) ends it. */
typedef struct view_surroundings {
    environment around;
    char name[VIEW_PATH_SIZE]; /* what it was made of; empty: nothing */
    float rotation, strength;
    int ground;
} view_surroundings;

/* Whether it is that of the settings. */
bool view_surroundings_match(const view_surroundings *surroundings, const view_settings *settings);

/* Opens that of the settings instead. On failure there is none. */
bool view_surroundings_open(view_surroundings *surroundings, const view_settings *settings,
                            const scene *world, cli_error *error);

#endif
