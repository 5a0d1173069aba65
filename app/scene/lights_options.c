/* SPDX-License-Identifier: MIT */
/* lights_options.c - the lights that a command line asks for. */
#include "app/scene/scene.h"
#include "app/scene/vector.h"

/* Points become spheres and parallel rays suns, of the same intensity and irradiance. */
static bool widen_lights(scene *s, const scene_lights_options *options, cli_error *error) {
    const float angle = options->sun_angle * PI / 180.0f;
    for (size_t i = 0; i < s->light_count; i++) {
        scene_light *light = &s->lights[i];
        const scene_light_kind *kind = &scene_light_kinds[light->emitter.kind];
        scene_light_error wrong;
        if (!kind->widen)
            continue;
        kind->widen(&light->emitter, options->point_radius, angle);
        if (!scene_light_check(light, &wrong))
            return cli_fail(error, s->name, "lights[%zu]%s with that %s", i, wrong.text,
                            kind->widened_by);
    }
    return true;
}

bool scene_apply_lights(scene *s, const scene_lights_options *options, cli_error *error) {
    if (!widen_lights(s, options, error))
        return false;
    s->lights_chosen = options->file || options->random_count > 0;
    if (s->lights_chosen && !options->keep)
        scene_clear_lights(s);
    if (options->keep && !s->lights_chosen)
        cli_note("--keep-lights", "changes nothing without --lights or --random-lights");
    if (options->seed && options->random_count == 0)
        cli_note("--seed", "changes nothing without --random-lights");
    const size_t before = s->light_count;
    if (options->file && !scene_add_lights_file(s, options->file, error))
        return false;
    if (options->file && s->light_count == before)
        cli_note(options->file,
                 "has no lights, so the scene is dark: add some to its \"lights\", such as "
                 "{ \"position\": [0, 3, 0], \"radius\": 0.2, \"power\": 100 }, or "
                 "leave --lights out");
    if (options->random_count > 0 &&
        !scene_add_random_lights(s, options->random_count, options->seed, error))
        return false;
    for (size_t i = 0; options->hide && i < s->light_count; i++)
        s->lights[i].hidden = 1;
    return true;
}
