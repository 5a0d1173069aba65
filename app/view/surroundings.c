/* SPDX-License-Identifier: MIT */
#include "app/view/surroundings.h"

#include <string.h>

bool view_surroundings_match(const view_surroundings *s, const view_settings *settings) {
    const view_environment *wanted = &settings->environment;
    return strcmp(s->of.name, wanted->name) == 0 && s->of.rotation == wanted->rotation &&
           s->of.strength == wanted->strength && s->of.ground == wanted->ground;
}

bool view_surroundings_open(view_surroundings *s, const view_settings *settings, const scene *world,
                            base_error *error) {
    const view_environment *of = &settings->environment;
    const environment_options options = {
        .name = of->name, .rotation = of->rotation, .strength = of->strength, .ground = of->ground
    };
    environment_free(&s->around);
    s->of.name[0] = '\0';
    if (!environment_open(&options, world, &s->around, error) ||
        !environment_extract_suns(&s->around, error))
        return false;
    s->of = *of;
    return true;
}
