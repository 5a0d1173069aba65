/* SPDX-License-Identifier: MIT */
#include "app/view/lights.h"
#include "app/view/nodes.h"

#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <math.h>
#include <string.h>

#define SIZE_STEP      1.15f
#define POWER_STEP     1.25f
#define HUE_STEP       (1.0f / 12)
#define NEW_POOL       4    /* the radiance under a new light, of a white surface, times exposure */
#define NEW_IRRADIANCE 0.4f /* that a new light gives the scene's bounding sphere */
#define COPY_DISTANCE  0.03f /* of the scene's diagonal, at least */
#define FRAMED_RADIUS  0.1f  /* of the scene's diagonal, at least */

float view_scene_diagonal(const scene *world) {
    return fmaxf(scene_diagonal(world), 1e-6f);
}

static bool is_changed(const view_state *s, size_t index) {
    return s->selected < 0 || (size_t)s->selected == index;
}

/* --- size ------------------------------------------------------------------------------------- */

/* Resizes a light. The power of spheres and areas stays, so a larger one is dimmer; cones and caps
 * widen. */
static void grow(scene_light *light, float by) {
    lmp_light *e = &light->emitter;
    const float extent = scene_light_extent(e) * by;
    if (extent > 1e-12f && extent < 1e12f) {
        scene_light_resize(e, by);
        e->radiance = (lmp_rgb) { fminf(e->radiance.r, SCENE_COLOR_MAX),
                                  fminf(e->radiance.g, SCENE_COLOR_MAX),
                                  fminf(e->radiance.b, SCENE_COLOR_MAX) };
    }
    for (const scene_light_member *m = scene_light_kinds[e->kind].members; m->name; m++)
        if (m->type == SCENE_LIGHT_ANGLE) {
            float *angle = scene_light_value(e, m);
            *angle = fminf(*angle * by, PI);
        }
}

void view_resize_lights(view_state *s, int sign) {
    for (size_t i = 0; i < s->now.light_count; i++)
        if (is_changed(s, i))
            grow(&s->now.lights[i], sign > 0 ? SIZE_STEP : 1 / SIZE_STEP);
    s->lights_edited = true;
}

/* --- color ------------------------------------------------------------------------------------ */

static void each_color(view_state *s, void (*change)(float color[3], float by), float by) {
    for (size_t i = 0; i < s->now.light_count; i++) {
        lmp_light *e = &s->now.lights[i].emitter;
        for (const scene_light_member *m = scene_light_kinds[e->kind].members; m->name; m++)
            if (is_changed(s, i) && m->type == SCENE_LIGHT_COLOR && !m->convert)
                change(scene_light_value(e, m), by);
    }
    s->lights_edited = true;
}

static void brighten(float color[3], float by) {
    for (int k = 0; k < 3; k++)
        color[k] = fminf(color[k] * by, SCENE_COLOR_MAX);
}

/* Rotates a color by a fraction of the hue circle around the gray axis, on which red, green and
 * blue follow each other. */
static void rotate_hue(float color[3], float by) {
    const float angle = 2 * PI * by, c = cosf(angle), s = sinf(angle), root = sqrtf(1.0f / 3);
    const float mean = (color[0] + color[1] + color[2]) / 3;
    float to[3];
    for (int k = 0; k < 3; k++) {
        const float across = root * (color[(k + 2) % 3] - color[(k + 1) % 3]);
        to[k] = fmaxf(0, color[k] * c + across * s + mean * (1 - c));
    }
    const float scale = rgb_brightest(to) > 0 ? rgb_brightest(color) / rgb_brightest(to) : 1;
    for (int k = 0; k < 3; k++)
        color[k] = to[k] * scale;
}

static void make_paler(float color[3], float by) {
    const float most = rgb_brightest(color);
    for (int k = 0; k < 3; k++)
        color[k] = fmaxf(0, color[k] + by * (most - color[k]));
}

void view_brighten_lights(view_state *s, int sign) {
    each_color(s, brighten, sign > 0 ? POWER_STEP : 1 / POWER_STEP);
}

void view_recolor_lights(view_state *s, int sign) {
    each_color(s, rotate_hue, sign > 0 ? HUE_STEP : -HUE_STEP);
}

void view_fade_lights(view_state *s, int sign) {
    each_color(s, make_paler, sign > 0 ? 0.25f : -1.0f / 3);
}

/* --- selecting, adding, removing -------------------------------------------------------------- */

void view_select_light(view_state *s, int step) {
    const int count = (int)s->now.light_count;
    if (count > 0)
        s->selected =
            s->selected < 0 ? (step > 0 ? 0 : count - 1) : (s->selected + step + count) % count;
}

/* Whether a light is selected; shows a message if none is. */
static bool is_selected(view_state *s) {
    if (s->selected < 0)
        view_say(s, "Select a light first: click it, or press Tab");
    return s->selected >= 0;
}

static lmp_light new_light(const view_state *s, lmp_light_kind kind) {
    return scene_light_model(kind, NEW_IRRADIANCE, view_scene_diagonal(s->world));
}

static view_ray pointer_ray(const view_state *s) {
    const bool outside = s->x < 0 || s->y < 0;
    return view_ray_at(s, outside ? 0.5 * s->now.width : s->x,
                       outside ? 0.5 * s->now.height : s->y);
}

/* Adds a light, and selects it. */
static void append(view_state *s, const scene_light *light) {
    if (s->now.light_count == SCENE_LIGHTS_MAX) {
        view_say(s, "There are %d lights already: no more fit", SCENE_LIGHTS_MAX);
        return;
    }
    s->selected = (int)s->now.light_count;
    s->muted[s->now.light_count] = false;
    s->numbers[s->now.light_count] = s->next_number++;
    s->now.lights[s->now.light_count++] = *light;
    s->lights_edited = true;
    s->drag = VIEW_DRAG_NONE;
}

/* Makes a new light as bright as suits the surface that it is over, whatever the size of the scene:
 * a white surface shows NEW_POOL times the brightest color. */
static void suit_surface(const view_state *s, lmp_vec3 point, lmp_vec3 normal, lmp_light *light) {
    const lmp_rgb received = lmp_light_irradiance(light, 1, point, normal);
    const float most = fmaxf(received.r, fmaxf(received.g, received.b));
    if (most > 0 && s->now.exposure > 0)
        light->radiance = rgb_scale(light->radiance, NEW_POOL * PI / (most * s->now.exposure));
}

/* Adds a light of the selected one's kind if that has a position, else a sphere: over the surface
 * under the pointer, or at the distance of the camera's target. */
void view_add_light(view_state *s, int unused) {
    (void)unused;
    const view_ray ray = pointer_ray(s);
    const view_hit hit = view_pick_surface(&ray, s->tree);
    const bool like_selected =
        s->selected >= 0 && scene_light_has(&s->now.lights[s->selected], SCENE_LIGHT_POSITION);
    scene_light light = { .emitter = like_selected ? s->now.lights[s->selected].emitter
                                                   : new_light(s, scene_light_kind_default) };
    const float reach = vec_length(vec_sub(vec_load(s->now.camera.target), ray.from));
    light.emitter.position =
        hit.mesh < 0
            ? vec_add(ray.from, vec_scale(ray.direction, reach))
            : vec_add(hit.point, vec_scale(hit.normal, 3 * scene_light_extent(&light.emitter)));
    if (hit.mesh >= 0 && !like_selected)
        suit_surface(s, hit.point, hit.normal, &light.emitter);
    append(s, &light);
}

void view_copy_light(view_state *s, int unused) {
    (void)unused;
    if (!is_selected(s))
        return;
    scene_light light = s->now.lights[s->selected];
    light.glow = light.glows_both = 0; /* the mesh that it may stand for is there once */
    light.hidden = 0;
    if (scene_light_has(&light, SCENE_LIGHT_POSITION))
        light.emitter.position.x += fmaxf(2.5f * scene_light_extent(&light.emitter),
                                          COPY_DISTANCE * view_scene_diagonal(s->world));
    append(s, &light);
}

void view_remove_light(view_state *s, int unused) {
    (void)unused;
    if (!is_selected(s))
        return;
    const size_t index = (size_t)s->selected, after = --s->now.light_count - index;
    memmove(&s->now.lights[index], &s->now.lights[index + 1], after * sizeof *s->now.lights);
    memset(&s->now.lights[s->now.light_count], 0, sizeof *s->now.lights);
    memmove(&s->numbers[index], &s->numbers[index + 1], after * sizeof *s->numbers);
    memmove(&s->muted[index], &s->muted[index + 1], after * sizeof *s->muted);
    s->selected = -1;
    s->drag = VIEW_DRAG_NONE;
    s->lights_edited = true;
}

/* --- kind, direction, view -------------------------------------------------------------------- */

void view_make_kind(view_state *s, int index, int kind) {
    lmp_light *light = &s->now.lights[index].emitter;
    const lmp_vec3 position = light->position;
    *light = new_light(s, (lmp_light_kind)kind);
    light->position = position; /* kept for a kind that has a position again */
    s->drag = VIEW_DRAG_NONE;
    s->lights_edited = true;
    view_say(s, "Light %d: %s", index, scene_light_kinds[kind].name);
}

void view_change_kind(view_state *s, int step) {
    if (!is_selected(s))
        return;
    const int kind = (int)s->now.lights[s->selected].emitter.kind + step;
    view_make_kind(s, s->selected, (kind + SCENE_LIGHT_KIND_COUNT) % SCENE_LIGHT_KIND_COUNT);
}

void view_mute_light(view_state *s, int unused) {
    (void)unused;
    if (is_selected(s))
        s->muted[s->selected] = !s->muted[s->selected];
}

void view_solo_light(view_state *s, int unused) {
    (void)unused;
    s->solo = !s->solo && is_selected(s);
}

void view_direct_light(view_state *s, int unused) {
    (void)unused;
    if (!is_selected(s))
        return;
    scene_light *light = &s->now.lights[s->selected];
    const view_ray ray = pointer_ray(s);
    const view_hit hit = view_pick_surface(&ray, s->tree);
    lmp_vec3 direction = ray.direction;
    if (!scene_light_has(light, SCENE_LIGHT_DIRECTION)) {
        view_say(s, "A %s light has no direction", scene_light_kinds[light->emitter.kind].name);
        return;
    }
    if (scene_light_has(light, SCENE_LIGHT_POSITION) && hit.mesh >= 0)
        direction = vec_sub(hit.point, light->emitter.position);
    light->emitter.direction = vec_normalize(direction, light->emitter.direction);
    s->lights_edited = true;
}

void view_frame_light(view_state *s, int unused) {
    (void)unused;
    if (s->selected < 0 && s->node >= 0)
        view_frame_node(s, 0);
    if (s->selected < 0 || !scene_light_has(&s->now.lights[s->selected], SCENE_LIGHT_POSITION))
        return;
    const lmp_light *light = &s->now.lights[s->selected].emitter;
    const float extent = scene_light_extent(light),
                radius = extent > 0 ? 10 * extent : FRAMED_RADIUS * view_scene_diagonal(s->world);
    view_frame(&s->now.camera, light->position, radius, view_aspect(&s->now));
}
