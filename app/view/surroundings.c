/* SPDX-License-Identifier: MIT */
#include "app/view/surroundings.h"

#include <string.h>

bool view_surroundings_match(const view_surroundings *s, const view_settings *settings) {
    return strcmp(s->name, settings->environment) == 0 &&
           s->rotation == settings->environment_rotation &&
           s->strength == settings->environment_strength && s->ground == settings->ground;
}

bool view_surroundings_open(view_surroundings *s, const view_settings *settings, const scene *world,
                            base_error *error) {
    const environment_options options = { .name = settings->environment,
                                          .rotation = settings->environment_rotation,
                                          .strength = settings->environment_strength,
                                          .ground = settings->ground };
    environment_free(&s->around);
    s->name[0] = '\0';
    if (!environment_open(&options, world, &s->around, error) ||
        !environment_extract_suns(&s->around, error))
        return false;
    memcpy(s->name, settings->environment, sizeof s->name);
    s->rotation = options.rotation;
    s->strength = options.strength;
    s->ground = options.ground;
    return true;
}
