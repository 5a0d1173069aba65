/* SPDX-License-Identifier: MIT */
/* files.c - handles files that are dropped onto the window, or opened by name. */
#include "app/base/file.h"
#include "app/image/image.h"
#include "app/scene/material.h"
#include "app/view/state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- materials -------------------------------------------------------------------------------- */

int view_material_at_pointer(const view_state *s) {
    view_ray ray;
    const view_hit hit = view_hit_at_pointer(s, &ray);
    return hit.mesh < 0 ? 0 : (int)s->world->meshes[hit.mesh].material;
}

bool view_replace_material(view_state *s, const char *name, const char *replacement,
                           base_error *error) {
    material opened;
    if (replacement) {
        if (!material_open(replacement, &opened, error))
            return false;
        material_close(&opened);
    }
    if (!view_set_material(&s->now, name, replacement))
        return base_fail(error, name, "cannot be replaced: too many materials, or too long a name");
    view_say(s, "%s is %s", name,
             replacement ? file_base_name(replacement) : "as the scene has it");
    return true;
}

/* Gives the material in a file to the object under the pointer. */
static bool take_material(view_state *s, const char *file, base_error *error) {
    view_ray ray;
    const view_hit hit = view_hit_at_pointer(s, &ray);
    if (hit.mesh < 0)
        return base_fail(error, file_base_name(file), "is a material: drop it onto an object");
    if (!view_replace_material(s, s->world->materials[s->world->meshes[hit.mesh].material].name,
                               file, error))
        return false;
    snprintf(s->dropped, sizeof s->dropped, "%s", file);
    return true;
}

/* --- lights and scenes ------------------------------------------------------------------------ */

static bool take_lights(view_state *s, const char *file, base_error *error) {
    size_t count;
    scene_light *lights = calloc(SCENE_LIGHTS_MAX, sizeof *lights);
    const bool ok =
        lights ? scene_read_lights(file, s->now.origin, SCENE_LIGHTS_MAX, lights, &count, error)
               : base_fail(error, NULL, "out of memory");
    if (ok) {
        view_put_lights(s, lights, count);
        view_say(s, "%s: %zu light%s", file_base_name(file), count, count == 1 ? "" : "s");
    }
    free(lights);
    return ok;
}

static bool take_scene(view_state *s, const char *file, base_error *error) {
    if (strlen(file) >= sizeof s->other)
        return base_fail(error, file, "is too long a name");
    strcpy(s->other, file);
    s->requests.reload = true;
    return true;
}

static const struct {
    const char *ending;
    bool (*take)(view_state *state, const char *file, base_error *error);
} kinds[] = {
    { ".json", take_lights },   { ".png", take_lights },    { ".binary", take_material },
    { ".bsdf", take_material }, { ".lmpt", take_material },
};

/* Opens a file by its extension. A colon separates the parameters of a material, so a name with a
 * colon is a material. */
bool view_take_file(view_state *s, const char *file, base_error *error) {
    const char *base = file_base_name(file), *dot = strrchr(base, '.');
    if (file_is_standard_input(file))
        return base_fail(error, file, "is not a file");
    for (size_t i = 0; dot && i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(dot, kinds[i].ending) == 0)
            return kinds[i].take(s, file, error);
    const bool named = strchr(base, ':') && scene_is_file(file);
    return named ? take_material(s, file, error) : take_scene(s, file, error);
}
