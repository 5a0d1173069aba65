/* SPDX-License-Identifier: MIT */
/* sidebar.c - every value as a field, and every action as a button. */
#include "app/scene/node.h"
#include "app/scene/vector.h"
#include "app/scene/world.h"
#include "app/view/lights.h"
#include "app/view/nodes.h"
#include "app/view/ui.h"
#include "app/view/viewer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* --- actions ---------------------------------------------------------------------------------- */

/* Puts the buttons of the rows below a heading, each with its help and key as the tooltip. */
static void put_buttons(view_state *s, const view_key *heading) {
    const view_key *told = heading;
    for (const view_key *row = heading + 1; (row->key || row->shown) && !view_is_heading(row);
         row++) {
        char tip[128];
        if (row->help)
            told = row;
        if (!row->name)
            continue;
        snprintf(tip, sizeof tip, "%s (%s)", told->help, told->shown);
        if (ui_button(row->name, tip, view_is_on(s, row)))
            view_handle(s, &(view_event) { .kind = VIEW_ACT, .text = row->name });
    }
}

/* Returns the heading after this one. */
static const view_key *next_heading(const view_key *row) {
    do
        row++;
    while ((row->key || row->shown) && !view_is_heading(row));
    return row;
}

/* --- values ----------------------------------------------------------------------------------- */

static void set(view_state *s, const char *path, const char *value) {
    base_error error;
    if (!view_set(s, path, value, &error))
        view_say(s, "%s", error.text);
}

/* Sets numbers, with the digits that restore them exactly. */
static void set_numbers(view_state *s, const char *path, const float *numbers, int count) {
    char text[128];
    size_t used = 0;
    for (int k = 0; k < count; k++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%.9g", k ? ", " : "",
                                 (double)numbers[k]);
    set(s, path, text);
}

static void put_choice(view_state *s, const char *name, const char *path,
                       const char *const *choices, int chosen) {
    if (ui_choice(name, choices, &chosen))
        set(s, path, choices[chosen]);
}

static void put_flag(view_state *s, const char *name, const char *path, bool on) {
    if (ui_flag(name, &on))
        set(s, path, on ? "true" : "false");
}

static void put_integer(view_state *s, const char *name, const char *path, int value, int least,
                        int most) {
    if (ui_integer(name, &value, least, most)) {
        const float number = (float)value;
        set_numbers(s, path, &number, 1);
    }
}

static void put_number(view_state *s, const char *name, const char *path, float value, float least,
                       float most, float step) {
    if (ui_numbers(name, &value, 1, least, most, step))
        set_numbers(s, path, &value, 1);
}

/* Puts a member of the settings in its range; numbers are dragged by `step` a pixel. */
static void put_member(view_state *s, const char *name, const char *path, float step) {
    char text[VIEW_PATH_SIZE];
    const view_member *m = view_find_member(path);
    const void *at = (const char *)&s->now + m->offset;
    switch (m->type) {
    case VIEW_FLAG:
        put_flag(s, name, path, *(const bool *)at);
        break;
    case VIEW_INTEGER:
        put_integer(s, name, path, *(const int *)at, (int)m->range[0], (int)m->range[1]);
        break;
    case VIEW_CHOICE:
        put_choice(s, name, path, view_choices(m), *(const int *)at);
        break;
    case VIEW_FLOAT:
        put_number(s, name, path, *(const float *)at, (float)m->range[0], (float)m->range[1], step);
        break;
    default:
        snprintf(text, sizeof text, "%s", (const char *)at);
        if (ui_line(name, text, sizeof text, false))
            set(s, path, text);
        break;
    }
}

/* --- files, camera, materials, time ------------------------------------------------------------
 */

/* Lists the scenes of earlier runs, by their names before their folders. */
static void put_files(viewer *v) {
    const view_recent *recent = &v->recent;
    char item[2 * VIEW_PATH_SIZE];
    if (recent->count == 0)
        return;
    ui_text("recent scenes");
    ui_list_begin("recent", recent->count);
    for (int i = 0; i < recent->count; i++) {
        const char *path = recent->scenes[i], *slash = strrchr(path, '/');
        snprintf(item, sizeof item, "%s%s%.*s##recent", slash ? slash + 1 : path, slash ? "  " : "",
                 slash ? (int)(slash - path) : 0, path);
        if (ui_item(item, i == 0) && i > 0)
            view_handle(&v->state, &(view_event) { .kind = VIEW_DROP, .text = path });
    }
    ui_list_end();
}

/* Returns how many nodes a node is below, and opens these if `opens`. */
static int depth_of(const scene *world, long node, bool opens) {
    int depth = 0;
    for (uint32_t at = world->nodes[node].parent; at != SCENE_NO_NODE; depth++) {
        if (opens)
            ui_open_item(at);
        at = world->nodes[at].parent;
    }
    return depth;
}

/* Lists the nodes as a tree, or those with a text in their names. */
static void put_scene(viewer *v) {
    view_state *s = &v->state;
    view_sidebar *bar = &v->sidebar;
    char item[SCENE_NAME_SIZE + 48];
    ui_line("find##node", bar->find_node, sizeof bar->find_node, true);
    const bool finds = bar->find_node[0];
    const bool chosen = s->node >= 0 && s->node != bar->node;
    ui_list_begin("nodes", 8);
    if (chosen)
        depth_of(s->world, s->node, true);
    bar->node = s->node;
    for (long i = 0, next; i < (long)s->world->node_count; i = next) {
        const long end = (long)s->world->nodes[i].end;
        const char *name = scene_node_name(s->world, (size_t)i);
        next = finds || (end > i + 1 && ui_is_open(i)) ? i + 1 : end;
        if (finds && !strcasestr(name, bar->find_node))
            continue;
        if (chosen && i == s->node)
            ui_reveal_item();
        if (!ui_sees_item())
            continue;
        snprintf(item, sizeof item, "%s%s##node", name[0] ? name : "(no name)",
                 view_node_is_hidden(s, (size_t)i) ? ", hidden" : "");
        if (ui_tree_item(i, item, finds ? 0 : depth_of(s->world, i, false), !finds && end > i + 1,
                         i == s->node))
            bar->node = s->node = i == s->node ? -1 : i;
    }
    ui_list_end();
}

static void put_camera(viewer *v) {
    view_state *s = &v->state;
    char item[SCENE_NAME_SIZE + 32], index[24];
    if (s->world->camera_count > 0) {
        ui_list_begin("cameras", s->world->camera_count < 5 ? (int)s->world->camera_count : 5);
        for (size_t i = 0; i < s->world->camera_count; i++) {
            if (!ui_sees_item())
                continue;
            snprintf(item, sizeof item, "%zu %s##camera", i, s->world->cameras[i].name);
            snprintf(index, sizeof index, "%zu", i);
            if (ui_item(item, i == (size_t)s->camera))
                set(s, "view/camera", index);
        }
        ui_list_end();
    }
    put_member(s, "fov", "camera/fov", 0.005f);
}

/* Puts what a material looks like, and the factors of glTF, those of the scene unless such factors
 * replace it. */
static void put_factors(view_state *s, view_ball *ball, const char *path, const scene_material *m,
                        const char *given) {
    float base[3], metallic = m->metallic, roughness = m->roughness, gray;
    char text[96];
    memcpy(base, m->base_color, sizeof base);
    if (given && sscanf(given, "gltf:%f:%f:%f", &gray, &roughness, &metallic) == 3)
        base[0] = base[1] = base[2] = gray;
    else if (given)
        sscanf(given, "gltf:%f,%f,%f:%f:%f", &base[0], &base[1], &base[2], &roughness, &metallic);
    bool changed = ui_tint("##tint of the base color", base);
    changed |= ui_numbers("base color", base, 3, 0, 1, 0.005f);
    changed |= ui_numbers("roughness", &roughness, 1, 0, 1, 0.005f);
    changed |= ui_numbers("metallic", &metallic, 1, 0, 1, 0.005f);
    snprintf(text, sizeof text, "gltf:%.4g,%.4g,%.4g:%.4g:%.4g", (double)base[0], (double)base[1],
             (double)base[2], (double)roughness, (double)metallic);
    if (changed)
        set(s, path, text);
    if (view_ball_draw(ball, given && !changed ? given : text))
        ui_image(ball->rgb, VIEW_BALL_SIZE);
}

static void put_materials(viewer *v) {
    view_state *s = &v->state;
    view_sidebar *bar = &v->sidebar;
    const int count = (int)s->world->material_count;
    char item[SCENE_NAME_SIZE + 16], path[SCENE_NAME_SIZE + 16], typed[VIEW_MATERIAL_SIZE];
    if (count == 0)
        return;
    bar->material = bar->material < count ? bar->material : 0;
    ui_line("find", bar->find, sizeof bar->find, true);
    ui_list_begin("materials", count < 6 ? count : 6);
    for (int i = 0; i < count; i++) {
        const char *name = s->world->materials[i].name;
        if (!strcasestr(name, bar->find) || !ui_sees_item())
            continue;
        snprintf(item, sizeof item, "%s##%d", name[0] ? name : "(no name)", i);
        if (ui_item(item, i == bar->material))
            bar->material = i;
    }
    ui_list_end();
    const char *name = s->world->materials[bar->material].name;
    const char *given = view_material_of(&s->now, name), *const *known = view_known_materials;
    snprintf(path, sizeof path, "materials/%s", name);
    snprintf(typed, sizeof typed, "%s", given ? given : "");
    if (ui_line("replaced by", typed, sizeof typed, false))
        set(s, path, typed);
    int chosen = 0;
    for (int i = 1; given && known[i]; i++)
        chosen = strcmp(given, known[i]) == 0 ? i : chosen;
    if (ui_choice("known ones", known, &chosen))
        set(s, path, chosen == 0 ? "" : known[chosen]);
    put_factors(s, &bar->ball, path, &s->world->materials[bar->material], given);
}

static void put_time(viewer *v) {
    view_state *s = &v->state;
    put_choice(s, "path", "view/path", s->paths.names, s->paths.at);
    put_number(s, "seconds", "view/seconds", (float)s->seconds, 0, 1e6f, 0.02f);
    put_flag(s, "playing", "view/playing", s->playing);
}

/* --- shading ---------------------------------------------------------------------------------- */

static void put_side(view_state *s, int side) {
    const view_shading *shading = &s->now.shading[side];
    char path[32], name[32];
    if (view_sides(&s->now) == 2)
        ui_text(side ? "right" : "left");
    snprintf(name, sizeof name, "method##%d", side);
    snprintf(path, sizeof path, "looks/%d/method", side);
    put_member(s, name, path, 0);
    snprintf(name, sizeof name, "bands##%d", side);
    snprintf(path, sizeof path, "looks/%d/bands", side);
    put_integer(s, name, path, shading->bands, 1, view_bands_max(shading));
    snprintf(name, sizeof name, "filter##%d", side);
    snprintf(path, sizeof path, "looks/%d/window", side);
    put_member(s, name, path, 0);
}

static void put_shading(viewer *v) {
    view_state *s = &v->state;
    for (int side = 0; side < view_sides(&s->now); side++)
        put_side(s, side);
    float stops = log2f(s->now.exposure);
    if (ui_numbers("exposure, EV", &stops, 1, -30, 30, 0.02f)) {
        const float exposure = exp2f(stops);
        set_numbers(s, "exposure", &exposure, 1);
    }
    put_member(s, "tone curve", "tone", 0);
    put_member(s, "shadows", "shadows", 0);
    put_member(s, "bounces", "bounces", 0);
    put_member(s, "ground", "ground", 0);
    put_member(s, "environment", "environment/name", 0);
    put_member(s, "rotation", "environment/rotation", 1);
    put_member(s, "strength", "environment/strength", 0.01f);
}

static void put_compare(viewer *v) {
    put_member(&v->state, "image", "split", 0);
    put_member(&v->state, "divider", "divider", 0.002f);
}

/* --- lights ----------------------------------------------------------------------------------- */

/* Puts a color in two parts: one that is picked, which leaves the brightest channel as bright as it
 * was, and its numbers. */
static void put_color(view_state *s, const char *name, const char *path, const float *value) {
    const float most = rgb_brightest(value), by = most > 0 ? 1 / most : 0;
    float tint[3] = { by * value[0], by * value[1], by * value[2] }, numbers[3];
    char hidden[64];
    snprintf(hidden, sizeof hidden, "##tint of %s", name);
    memcpy(numbers, value, sizeof numbers);
    if (ui_tint(hidden, tint) && rgb_brightest(tint) > 0) {
        for (int k = 0; k < 3; k++)
            numbers[k] = tint[k] / rgb_brightest(tint) * (most > 0 ? most : 1);
        set_numbers(s, path, numbers, 3);
    } else if (ui_numbers(name, numbers, 3, 0, SCENE_COLOR_MAX, 0.005f * (most > 0 ? most : 1))) {
        set_numbers(s, path, numbers, 3);
    }
}

/* Puts a position far from 0 as text, which keeps digits that a float has not. */
static void put_world(view_state *s, const char *name, const char *path, const float *position) {
    char text[3 * sizeof(scene_world_text) + 8];
    scene_world_text at[3];
    for (int k = 0; k < 3; k++)
        scene_print_world(s->now.origin[k], position[k], 9, at[k]);
    snprintf(text, sizeof text, "%s, %s, %s", at[0], at[1], at[2]);
    if (ui_line(name, text, sizeof text, false))
        set(s, path, text);
}

/* Puts numbers in the units of the file: a member may give another quantity than is kept. */
static void put_light_member(view_state *s, const scene_light_member *m, float diagonal) {
    char path[64];
    lmp_light light = s->now.lights[s->selected].emitter;
    const float unit = m->convert ? m->convert(&light, 1) : 1;
    const int count = scene_light_count(&light, m);
    float numbers[3], *const value = scene_light_value(&light, m);
    snprintf(path, sizeof path, "lights/%d/%s", s->selected, m->name);
    if (m->type == SCENE_LIGHT_FLAG)
        put_flag(s, m->name, path, *scene_light_flag(&light, m));
    const bool far_away = m->type == SCENE_LIGHT_POSITION && !scene_origin_is_0(s->now.origin);
    if (far_away)
        put_world(s, m->name, path, value);
    if (far_away || m->type == SCENE_LIGHT_FLAG || m->type == SCENE_LIGHT_CORNERS)
        return;
    for (int k = 0; k < count; k++)
        numbers[k] = value[k] / unit;
    const float size = fmaxf(fabsf(numbers[0]), 1e-3f * diagonal), far = LMP_LENGTH_MAX;
    bool changed = false;
    switch (m->type) {
    case SCENE_LIGHT_COLOR:
        put_color(s, m->name, path, numbers);
        break;
    case SCENE_LIGHT_RADIUS:
        changed = ui_numbers(m->name, numbers, count, 1e-6f * diagonal, far, 0.01f * size);
        break;
    case SCENE_LIGHT_ANGLE:
        changed = ui_numbers(m->name, numbers, count, 0, PI, 0.005f);
        break;
    case SCENE_LIGHT_DIRECTION:
        changed = ui_numbers(m->name, numbers, count, -1, 1, 0.005f);
        break;
    default:
        changed = ui_numbers(m->name, numbers, count, -far, far, 0.002f * diagonal);
        break;
    }
    if (changed)
        set_numbers(s, path, numbers, count);
}

static void put_lights(viewer *v) {
    view_state *s = &v->state;
    const char *kinds[SCENE_LIGHT_KIND_COUNT + 1] = { NULL };
    const int count = (int)s->now.light_count;
    char item[96], path[32];
    for (int i = 0; i < SCENE_LIGHT_KIND_COUNT; i++)
        kinds[i] = scene_light_kinds[i].name;
    if (count > 0) {
        const bool chosen = s->selected != v->sidebar.light; /* elsewhere */
        ui_list_begin("lights", count < 6 ? count : 6);
        for (int i = 0; i < count; i++) {
            if (chosen && i == s->selected)
                ui_reveal_item();
            if (!ui_sees_item())
                continue;
            snprintf(item, sizeof item, "%d %s%s##light", i, kinds[s->now.lights[i].emitter.kind],
                     s->muted[i] ? ", muted" : "");
            if (ui_item(item, i == s->selected))
                s->selected = i;
        }
        v->sidebar.light = s->selected;
        ui_list_end();
    }
    if (s->selected < 0)
        return;
    snprintf(path, sizeof path, "lights/%d/kind", s->selected);
    put_choice(s, "kind", path, kinds, (int)s->now.lights[s->selected].emitter.kind);
    const lmp_light_kind kind = s->now.lights[s->selected].emitter.kind;
    for (const scene_light_member *m = scene_light_kinds[kind].members; m->name; m++)
        put_light_member(s, m, view_scene_diagonal(s->world));
}

/* --- statistics ------------------------------------------------------------------------------- */

int view_passes(const viewer *v, view_pass passes[VIEW_PASSES]) {
    const render_times *t = &v->told.statistics.times;
    const view_pass all[VIEW_PASSES] = {
        { "Geometry", t->surfaces }, { "Shading", t->shade },
        { "Shadows", t->shadow },    { "Bounces", t->bounces },
        { "Transfer", t->transfer }, { "Window", 1e3 * v->told.show_seconds },
    };
    int count = 0;
    for (int i = 0; i < VIEW_PASSES; i++)
        if (all[i].ms >= 0.05)
            passes[count++] = all[i];
    return count;
}

static void put_window(viewer *v) {
    view_pass passes[VIEW_PASSES];
    const int count = view_passes(v, passes);
    char text[64];
    float most = 1;
    for (int i = 0; i < VIEW_FRAMES_TOLD; i++)
        most = fmaxf(most, v->sidebar.ms[i]);
    snprintf(text, sizeof text, "ms of the last frames, up to %.0f", (double)most);
    ui_graph(text, v->sidebar.ms, VIEW_FRAMES_TOLD, most);
    for (int i = 0; i < count; i++) {
        snprintf(text, sizeof text, "%s %.1f ms", passes[i].name, passes[i].ms);
        ui_text(text);
    }
}

/* --- all of it -------------------------------------------------------------------------------- */

/* What is under a heading above its buttons. */
static const struct {
    const char *heading;
    void (*put)(viewer *v);
} contents[] = {
    { "Files", put_files },     { "Scene", put_scene },         { "Camera", put_camera },
    { "Shading", put_shading }, { "Materials", put_materials }, { "Compare", put_compare },
    { "Lights", put_lights },   { "Time", put_time },           { "Window", put_window },
};

static void put_section(viewer *v, const view_key *heading) {
    if (!ui_section(heading->shown, strcmp(heading->shown, "Lights") == 0))
        return;
    for (size_t i = 0; i < sizeof contents / sizeof *contents; i++)
        if (strcmp(contents[i].heading, heading->shown) == 0)
            contents[i].put(v);
    put_buttons(&v->state, heading);
}

double view_draw_sidebar(viewer *v) {
    view_state *s = &v->state;
    const int width = s->now.width;
    if (!s->sidebar && !view_is_interactive(v))
        return width;
    const double wide = fmin(VIEW_SIDEBAR_WIDTH * v->state.scale, 0.5 * width);
    bool open = s->sidebar;
    const bool seen = ui_sidebar_begin(VIEW_SIDEBAR_TITLE, wide, &open);
    s->sidebar = open;
    if (seen)
        for (const view_key *row = view_keys; row->shown; row = next_heading(row))
            put_section(v, row);
    ui_sidebar_end();
    return open ? width - wide : width;
}
