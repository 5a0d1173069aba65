/* SPDX-License-Identifier: MIT */
/* lights_options.c - the lights that a command line asks for. */
#include "app/scene/scene.h"
#include "app/scene/space.h"
#include "app/scene/vector.h"

#include <stdlib.h>

/* Turns points into spheres and parallel rays into suns, of the same intensity and irradiance. */
static bool widen_lights(scene *s, const scene_lights_options *options, base_error *error) {
    const float angle = options->sun_angle * PI / 180.0f;
    for (size_t i = 0; i < s->light_count; i++) {
        scene_light *light = &s->lights[i];
        const scene_light_kind *kind = &scene_light_kinds[light->emitter.kind];
        scene_light_error wrong;
        if (!kind->widen)
            continue;
        kind->widen(&light->emitter, options->point_radius, angle);
        if (!scene_light_check(light, &wrong))
            return base_fail(error, s->name, "lights[%zu]%s with that %s", i, wrong.text,
                             kind->widened_by);
    }
    return true;
}

/* Notes lights with backs of triangles above and below, which cast shadows on all else. Hidden
 * lights are skipped, because their emissive meshes surround them. */
static void tell_enclosed(const scene *s) {
    space_ball *balls = malloc((s->light_count + 1) * sizeof *balls);
    size_t count = 0, enclosed = 0, first = SIZE_MAX;
    for (size_t i = 0; balls && i < s->light_count; i++)
        if (!s->lights[i].hidden && scene_light_has(&s->lights[i], SCENE_LIGHT_POSITION))
            balls[count++] = (space_ball) { .center = s->lights[i].emitter.position, .number = i };
    if (count > 0)
        space_fit(s, balls, count);
    for (size_t i = 0; i < count; i++)
        if (balls[i].above_is_back && balls[i].below_is_back) {
            enclosed++;
            first = balls[i].number < first ? balls[i].number : first;
        }
    free(balls);
    if (enclosed == 1)
        base_note(s->name,
                  "light %zu is inside closed geometry: with shadows it lights nothing else",
                  first);
    else if (enclosed > 1)
        base_note(
            s->name,
            "%zu lights are inside closed geometry, the first of them light %zu: with shadows "
            "they light nothing else",
            enclosed, first);
}

bool scene_apply_lights(scene *s, const scene_lights_options *options, base_error *error) {
    if (!widen_lights(s, options, error))
        return false;
    s->lights_chosen = options->file || options->random_count > 0;
    if (s->lights_chosen && !options->keep)
        scene_clear_lights(s);
    if (options->keep && !s->lights_chosen)
        base_note("--keep-lights", "changes nothing without --lights or --random-lights");
    if (options->seed && options->random_count == 0)
        base_note("--seed", "changes nothing without --random-lights");
    const size_t before = s->light_count;
    if (options->file && !scene_add_lights_file(s, options->file, error))
        return false;
    if (options->file && s->light_count == before)
        base_note(options->file,
                  "has no lights, so the scene is dark: add some to its \"lights\", such as "
                  "{ \"position\": [0, 3, 0], \"radius\": 0.2, \"power\": 100 }, or "
                  "leave --lights out");
    if (options->random_count > 0 &&
        !scene_add_random_lights(s, options->random_count, options->seed, error))
        return false;
    tell_enclosed(s);
    for (size_t i = 0; options->hide && i < s->light_count; i++)
        s->lights[i].hidden = 1;
    return true;
}
