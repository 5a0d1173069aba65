/* SPDX-License-Identifier: MIT */
#include "app/view/state.h"

#include "app/scene/vector.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define MESSAGE_SECONDS 5.0

void view_say(view_state *s, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(s->message, sizeof s->message, format, arguments);
    va_end(arguments);
    s->message_until = s->clock + MESSAGE_SECONDS;
}

/* --- opening ---------------------------------------------------------------------------------- */

static bool add_path(view_state *s, const char *name, base_error *error) {
    view_paths *p = &s->paths;
    if (!animation_open(name, s->world, &p->animations[p->count], error))
        return false;
    p->names[p->count++] = name;
    p->names[p->count] = NULL;
    return true;
}

static void close_paths(view_paths *p) {
    for (int i = 0; i < p->count; i++)
        animation_close(p->animations[i]);
    p->count = p->at = 0;
}

static bool open_paths(view_state *s, const char *animate, base_error *error) {
    static const char *const known[] = { "orbit", "bounce", "scene" };
    const int count = s->world->motion_count > 0 ? 3 : 2;
    bool listed = !animate;
    for (int i = 0; i < count; i++) {
        if (!add_path(s, known[i], error))
            return false;
        if (animate && strcmp(animate, known[i]) == 0) {
            listed = true;
            s->paths.at = i;
        }
    }
    if (listed)
        return true;
    s->paths.at = s->paths.count;
    return add_path(s, animate, error);
}

void view_put_lights(view_state *s, const scene_light *lights, size_t count) {
    memset(s->now.lights, 0, sizeof s->now.lights);
    memcpy(s->now.lights, lights, count * sizeof *lights);
    s->now.light_count = count;
    for (size_t i = 0; i < count; i++)
        s->numbers[i] = i;
    s->next_number = count;
    memset(s->muted, 0, sizeof s->muted);
    s->solo = false;
    s->lights_edited = true;
    s->selected = -1;
    s->drag = VIEW_DRAG_NONE;
}

bool view_change_light(view_state *s, const scene_light *light) {
    scene_light_error wrong;
    if (!scene_light_check(light, &wrong))
        return false;
    s->now.lights[s->selected] = *light;
    s->lights_edited = true;
    return true;
}

/* Takes the lights of the scene; there is nothing to undo yet. */
static void take_lights(view_state *s) {
    view_put_lights(s, s->world->lights, s->world->light_count);
    s->lights_edited = false;
    view_history_clear(&s->history);
    view_history_keep(&s->history, &s->now, s->numbers);
}

bool view_state_open(const scene *world, view_tree *tree, const view_settings *settings,
                     const char *animate, view_state *s, base_error *error) {
    memset(s, 0, sizeof *s);
    s->world = world;
    s->tree = tree;
    s->now = *settings;
    s->now.up = world->up;
    s->overlay = s->handles = true;
    s->scale = 1;
    s->playing = animate != NULL;
    s->x = s->y = -1;
    s->node = -1;
    s->walking = scene_is_inside(world);
    take_lights(s);
    if (open_paths(s, animate, error))
        return true;
    close_paths(&s->paths);
    return false;
}

void view_state_close(view_state *s) {
    close_paths(&s->paths);
    view_history_clear(&s->history);
    view_shares_free(&s->shares);
}

void view_use_default_camera(view_state *s) {
    s->camera = 0;
    s->now.camera = scene_default_camera(s->world, view_aspect(&s->now));
    s->now.camera.near = s->now.camera.far = 0; /* it may fly past the file's planes */
}

/* Resets the state for another scene, as if the viewer had been started with it. */
static void begin_other(view_state *s) {
    strcpy(s->now.scene, s->other);
    s->other[0] = s->now.variant[0] = '\0';
    memset(&s->now.materials, 0, sizeof s->now.materials);
    memset(&s->now.hidden, 0, sizeof s->now.hidden);
    view_use_default_camera(s);
    s->seconds = 0;
    s->panel = (view_panel) { .kind = VIEW_PANEL_CLOSED };
    s->walking = scene_is_inside(s->world);
    s->requests.expose = true;
    take_lights(s);
}

/* Rebases what stays of a replaced scene, so that it stays at its position in the world; the undo
 * history, relative to the other origin, is cleared. */
static void follow_origin(view_state *s) {
    if (memcmp(s->now.origin, s->world->origin, sizeof s->now.origin) == 0)
        return;
    view_settings_rebase(&s->now, s->world->origin);
    view_history_clear(&s->history);
    view_history_keep(&s->history, &s->now, s->numbers);
}

bool view_state_replace_scene(view_state *s, const scene *world, view_tree *tree,
                              base_error *error) {
    view_paths before = s->paths;
    const scene *world_before = s->world;
    const char *name = before.names[before.at];
    s->world = world;
    s->paths.count = s->paths.at = 0;
    if (!open_paths(s, name, error)) {
        close_paths(&s->paths);
        /* the new scene may lack the motion that was playing; do without it */
        if (!open_paths(s, NULL, error)) {
            close_paths(&s->paths);
            s->paths = before;
            s->world = world_before;
            return false;
        }
    }
    s->now.up = world->up;
    s->tree = tree;
    s->node = -1;
    close_paths(&before);
    follow_origin(s);
    if (s->other[0])
        begin_other(s);
    else if (!s->lights_edited)
        take_lights(s);
    return true;
}

void view_undo(view_state *s, int step) {
    const view_hidden before = s->now.hidden;
    if (!view_history_step(&s->history, step, &s->now, s->numbers)) {
        view_say(s, step < 0 ? "Nothing to undo" : "Nothing was undone");
        return;
    }
    s->requests.nodes |= memcmp(&before, &s->now.hidden, sizeof before) != 0;
    s->lights_edited = true;
    memset(s->muted, 0, sizeof s->muted);
    if (s->selected >= (int)s->now.light_count)
        s->selected = -1;
    s->drag = VIEW_DRAG_NONE;
}

/* --- what is shown ---------------------------------------------------------------------------- */

/* Moves a light from where it rests to where it is in the animation. */
static void move_light(const view_state *s, size_t index, scene_light *light) {
    if (s->seconds > 0)
        animation_move(s->paths.animations[s->paths.at], s->numbers[index], s->seconds, light);
}

/* Turns a light off. */
static void mute(scene_light *light) {
    lmp_light *e = &light->emitter;
    for (const scene_light_member *m = scene_light_kinds[e->kind].members; m->name; m++)
        if (m->type == SCENE_LIGHT_COLOR)
            memset(scene_light_value(e, m), 0, 3 * sizeof(float));
    light->hidden = 1;
}

void view_shown(const view_state *s, view_settings *shown) {
    memcpy(shown, &s->now, view_settings_size(&s->now));
    for (size_t i = 0; i < shown->light_count; i++)
        move_light(s, i, &shown->lights[i]);
    for (size_t i = 0; i < shown->light_count; i++)
        if (s->solo && s->selected >= 0 ? i != (size_t)s->selected : s->muted[i])
            mute(&shown->lights[i]);
}

scene_light view_shown_light(const view_state *s, int index) {
    scene_light light = s->now.lights[index];
    move_light(s, (size_t)index, &light);
    return light;
}

view_ray view_ray_at(const view_state *s, double x, double y) {
    return view_ray_through(&s->now.camera, s->now.width, s->now.height, x, y);
}

view_ray view_pointer_ray(const view_state *s) {
    return view_ray_at(s, s->x, s->y);
}

view_hit view_hit_at_pointer(const view_state *s, view_ray *ray) {
    *ray = view_pointer_ray(s);
    return view_pick_surface(ray, s->tree);
}

void view_frame_box(view_state *s, const float lo[3], const float hi[3]) {
    const lmp_vec3 a = vec_load(lo), b = vec_load(hi);
    view_frame(&s->now.camera, vec_scale(vec_add(a, b), 0.5f), 0.5f * vec_length(vec_sub(b, a)),
               view_aspect(&s->now));
}

int view_side(const view_state *s) {
    return s->now.split == GPU_SPLIT_DIVIDED &&
           s->x >= (double)s->now.divider * (double)s->now.width;
}
