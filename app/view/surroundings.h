/* SPDX-License-Identifier: MIT */
/* surroundings.h - the environment of the settings drawn last. */
#ifndef LAMPION_VIEW_SURROUNDINGS_H
#define LAMPION_VIEW_SURROUNDINGS_H

#include "app/view/settings.h"

/* An environment and its name; zero: none. Free with environment_free(&around). */
typedef struct view_surroundings {
    environment around;
    view_environment of; /* what it was made from; without a name: nothing */
} view_surroundings;

/* Whether the environment is that of the settings. */
bool view_surroundings_match(const view_surroundings *surroundings, const view_settings *settings);

/* Replaces the environment by that of the settings. On failure there is none. */
bool view_surroundings_open(view_surroundings *surroundings, const view_settings *settings,
                            const scene *world, base_error *error);

#endif
