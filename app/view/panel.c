/* SPDX-License-Identifier: MIT */
#include "app/view/panel.h"
#include "app/scene/world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- the light -------------------------------------------------------------------------------- */

static const scene_light_member *light_members(const view_state *s) {
    return scene_light_kinds[s->now.lights[s->selected].emitter.kind].members;
}

static int count_light(const view_state *s) {
    int count = 0;
    while (s->selected >= 0 && light_members(s)[count].name)
        count++;
    return count;
}

/* Describes a light's row. A member that is another quantity is proportional to the value computed
 * from it. */
static void describe_light(const view_state *s, int row, view_row *to) {
    const scene_light_member *m = &light_members(s)[row];
    lmp_light light = s->now.lights[s->selected].emitter;
    const float *value = scene_light_value(&light, m);
    const float unit = m->convert ? m->convert(&light, 1) : 1;
    size_t used = 0;
    snprintf(to->name, sizeof to->name, "%s", m->name);
    if (m->type == SCENE_LIGHT_CORNERS)
        snprintf(to->value, sizeof to->value, "%d", light.corner_count);
    if (m->type == SCENE_LIGHT_FLAG)
        snprintf(to->value, sizeof to->value, "%s",
                 *scene_light_flag(&light, m) ? "true" : "false");
    for (int k = 0; m->type != SCENE_LIGHT_CORNERS && k < scene_light_count(&light, m); k++) {
        scene_world_text text;
        scene_print_world(m->type == SCENE_LIGHT_POSITION ? s->now.origin[k] : 0.0, value[k] / unit,
                          5, text);
        used += (size_t)snprintf(to->value + used, sizeof to->value - used, "%s%s", k ? ", " : "",
                                 text);
    }
}

static bool apply_light(view_state *s, int row, const char *typed, base_error *error) {
    return view_set_light(s, (size_t)s->selected, light_members(s)[row].name, typed, error);
}

/* --- materials -------------------------------------------------------------------------------- */

static int count_materials(const view_state *s) {
    return (int)s->world->material_count;
}

static void describe_material(const view_state *s, int row, view_row *to) {
    const char *name = s->world->materials[row].name, *given = view_material_of(&s->now, name);
    snprintf(to->name, sizeof to->name, "%.*s", (int)sizeof to->name - 1, name);
    snprintf(to->value, sizeof to->value, "%.*s", (int)sizeof to->value - 1,
             given ? given : "as in the scene");
}

static bool apply_material(view_state *s, int row, const char *typed, base_error *error) {
    return view_replace_material(s, s->world->materials[row].name, typed[0] ? typed : NULL, error);
}

/* --- files ------------------------------------------------------------------------------------ */

static int count_open(const view_state *s) {
    (void)s;
    return 1;
}

static void describe_open(const view_state *s, int row, view_row *to) {
    (void)row;
    snprintf(to->name, sizeof to->name, "file");
    snprintf(to->value, sizeof to->value, "%.*s", (int)sizeof to->value - 1, s->now.scene);
}

static bool apply_open(view_state *s, int row, const char *typed, base_error *error) {
    (void)row;
    s->panel.kind = VIEW_PANEL_CLOSED;
    return view_take_file(s, typed, error);
}

/* --- any -------------------------------------------------------------------------------------- */

static const struct {
    char title[sizeof((view_row *)NULL)->name];
    int (*count)(const view_state *state);
    void (*describe)(const view_state *state, int row, view_row *to);
    bool (*apply)(view_state *state, int row, const char *typed, base_error *error);
} panels[VIEW_PANELS] = {
    [VIEW_PANEL_LIGHT] = { "Light", count_light, describe_light, apply_light },
    [VIEW_PANEL_MATERIALS] = { "Materials", count_materials, describe_material, apply_material },
    [VIEW_PANEL_OPEN] = { "Open scene, lights or material", count_open, describe_open, apply_open },
};

static void open_panel(view_state *s, view_panel_kind kind, int row) {
    s->panel = (view_panel) { .kind = kind, .row = row };
}

void view_toggle_panel(view_state *s, int unused) {
    (void)unused;
    if (s->panel.kind != VIEW_PANEL_CLOSED)
        open_panel(s, VIEW_PANEL_CLOSED, 0);
    else if (s->selected >= 0)
        open_panel(s, VIEW_PANEL_LIGHT, 0);
    else if (s->world->material_count > 0)
        open_panel(s, VIEW_PANEL_MATERIALS, view_material_at_pointer(s));
}

void view_ask_file(view_state *s, int unused) {
    (void)unused;
    open_panel(s, VIEW_PANEL_OPEN, 0);
    s->panel.typing = true;
}

static void apply(view_state *s) {
    base_error error;
    char typed[VIEW_TYPED_SIZE];
    memcpy(typed, s->panel.typed, sizeof typed);
    s->panel.typing = false;
    if (!panels[s->panel.kind].apply(s, s->panel.row, typed, &error))
        view_say(s, "%s", error.text);
}

static void begin_typing(view_panel *p) {
    if (!p->typing)
        memset(p->typed, 0, sizeof p->typed);
    p->typing = true;
}

static void type_text(view_panel *p, const char *text) {
    begin_typing(p);
    const size_t used = strlen(p->typed);
    if (used + strlen(text) < sizeof p->typed)
        strcpy(p->typed + used, text);
}

/* Erases the last character, whole in UTF-8. */
static void erase(view_panel *p) {
    begin_typing(p);
    size_t used = strlen(p->typed);
    while (used > 0 && ((unsigned char)p->typed[used - 1] & 0xC0) == 0x80)
        used--;
    if (used > 0)
        used--;
    memset(p->typed + used, 0, sizeof p->typed - used);
}

static int least(int a, int b) {
    return a < b ? a : b;
}

/* Whether a key is text: keys with names of more than one character are not. */
static bool is_text(const char *key) {
    const unsigned char first = (unsigned char)key[0];
    return first >= 0x80 || (first > ' ' && key[1] == '\0');
}

bool view_panel_take_key(view_state *s, const char *key) {
    view_panel *p = &s->panel;
    if (p->kind == VIEW_PANEL_CLOSED)
        return false;
    const int count = panels[p->kind].count(s);
    if (count == 0) { /* its light has been removed */
        open_panel(s, VIEW_PANEL_CLOSED, 0);
        return false;
    }
    p->row = least(p->row, count - 1);
    if (is_text(key))
        type_text(p, key);
    else if (strcmp(key, "space") == 0 && p->typing)
        type_text(p, " ");
    else if (strcmp(key, "Backspace") == 0)
        erase(p);
    else if (strcmp(key, "Up") == 0 || strcmp(key, "Down") == 0)
        open_panel(s, p->kind, (p->row + (key[0] == 'U' ? count - 1 : 1)) % count);
    else if (strcmp(key, "Enter") == 0 && p->typing)
        apply(s);
    else if (strcmp(key, "Escape") == 0 && p->typing && p->kind != VIEW_PANEL_OPEN)
        p->typing = false;
    else if (strcmp(key, "Escape") == 0)
        open_panel(s, VIEW_PANEL_CLOSED, 0);
    else
        return false;
    return true;
}

/* Describes the typed text; if it is too long, its end, where the cursor is. */
static void describe_typed(const char *typed, view_row *to) {
    const int used = (int)strlen(typed), room = (int)sizeof to->value - 4;
    const char *shown = used > room ? typed + used - room : typed;
    snprintf(to->value, sizeof to->value, "%.*s▏", room, shown);
}

int view_panel_rows(const view_state *s, view_row rows[VIEW_PANEL_ROWS]) {
    const view_panel *p = &s->panel;
    const int all = p->kind == VIEW_PANEL_CLOSED ? 0 : panels[p->kind].count(s);
    const int shown = least(all, VIEW_PANEL_ROWS - 1), chosen = least(p->row, all - 1);
    const int top = chosen - shown / 2, first = top < 0 ? 0 : least(top, all - shown);
    if (all == 0)
        return 0;
    memset(rows, 0, VIEW_PANEL_ROWS * sizeof *rows);
    snprintf(rows[0].name, sizeof rows[0].name, "%s", panels[p->kind].title);
    for (int i = 0; i < shown; i++) {
        view_row *to = &rows[1 + i];
        panels[p->kind].describe(s, first + i, to);
        to->chosen = first + i == chosen;
        if (to->chosen && p->typing)
            describe_typed(p->typed, to);
    }
    return 1 + shown;
}
