/* SPDX-License-Identifier: MIT */
/* keys.c - all actions: their keys, buttons and help. */
#include "app/scene/vector.h"
#include "app/view/aim.h"
#include "app/view/lights.h"
#include "app/view/nodes.h"
#include "app/view/panel.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define FRAME_SECONDS (1.0 / 24)

/* --- shading ---------------------------------------------------------------------------------- */

static view_shading *shading_here(view_state *s) {
    return &s->now.shading[view_side(s)];
}

static void change_method(view_state *s, int step) {
    view_shading *shading = shading_here(s);
    shading->method = (method_kind)(((int)shading->method + step + METHODS) % METHODS);
    view_hold_bands(shading);
}

static void change_bands(view_state *s, int step) {
    shading_here(s)->bands += step;
    view_hold_bands(shading_here(s));
}

static void change_window(view_state *s, int step) {
    view_shading *shading = shading_here(s);
    shading->window =
        (lmp_window)(((int)shading->window + step + LMP_WINDOW_COUNT) % LMP_WINDOW_COUNT);
}

static void change_exposure(view_state *s, int thirds) {
    s->now.exposure *= exp2f((float)thirds / 3);
    s->now.exposure = fminf(fmaxf(s->now.exposure, 1e-12f), 1e12f);
}

static void change_tone(view_state *s, int step) {
    int count = 0;
    while (image_tones[count].name)
        count++;
    s->now.tone = (s->now.tone + step + count) % count;
    view_say(s, "Tone curve: %s", image_tones[s->now.tone].name);
}

/* Splits the image, or joins it again. Both sides begin with the same settings, so that the first
 * change shows its effect. */
static void split(view_state *s, int kind) {
    const bool was_whole = s->now.split == GPU_SPLIT_NONE;
    s->now.split = s->now.split == (gpu_split)kind ? GPU_SPLIT_NONE : (gpu_split)kind;
    if (was_whole)
        s->now.shading[1] = s->now.shading[0];
    if (was_whole && kind == GPU_SPLIT_DIVIDED) {
        s->now.divider = 0.5f;
        view_say(s, "Split: the panel sets each side, keys the side that the pointer is on");
    } else if (s->now.split == GPU_SPLIT_DIFFERENCE) {
        view_say(s, "Difference of both sides, times %d", GPU_DIFFERENCE_GAIN);
    }
}

static void toggle_shadows(view_state *s, int unused) {
    (void)unused;
    s->now.shadows = !s->now.shadows;
    view_say(s, s->now.shadows ? "Shadows" : "No shadows");
}

static void toggle_bounces(view_state *s, int bounces) {
    s->now.bounces = s->now.bounces > 0 ? 0 : bounces;
    view_say(s, s->now.bounces > 0 ? "Light bounces" : "Direct light alone");
}

static void swap_sides(view_state *s, int unused) {
    (void)unused;
    const view_shading first = s->now.shading[0];
    if (s->now.split == GPU_SPLIT_NONE)
        return;
    s->now.shading[0] = s->now.shading[1];
    s->now.shading[1] = first;
}

/* --- time ------------------------------------------------------------------------------------- */

static void change_path(view_state *s, int step) {
    s->paths.at = (s->paths.at + step) % s->paths.count;
    s->playing = true;
    view_say(s, "Lights: %s", s->paths.names[s->paths.at]);
}

static void step_time(view_state *s, int step) {
    s->playing = false;
    s->seconds = fmax(0, s->seconds + step * FRAME_SECONDS);
}

static void rewind_time(view_state *s, int unused) {
    (void)unused;
    s->seconds = 0;
}

/* --- materials -------------------------------------------------------------------------------- */

const char *const view_known_materials[] = {
    "as in the scene",  "lambert:0.8", "phong:50:0.8",     "ggx:0.1:0.9",    "ggx:0.35:0.04:0.5",
    "sgd:chrome-steel", "sgd:brass",   "sgd:blue-acrylic", "sgd:red-fabric", NULL
};

static void change_material(view_state *s, int step) {
    view_ray ray;
    const view_hit hit = view_hit_at_pointer(s, &ray);
    base_error error;
    if (hit.mesh < 0) {
        view_say(s, "Point at an object to change its material");
        return;
    }
    const char *name = s->world->materials[s->world->meshes[hit.mesh].material].name;
    const char *current = view_material_of(&s->now, name);
    const char *choices[sizeof view_known_materials / sizeof *view_known_materials + 1] = { NULL };
    int count = 1, at = 0;
    while (view_known_materials[count]) {
        choices[count] = view_known_materials[count];
        count++;
    }
    if (s->dropped[0])
        choices[count++] = s->dropped;
    for (int i = 1; i < count; i++)
        if (current && strcmp(current, choices[i]) == 0)
            at = i;
    if (!view_replace_material(s, name, choices[(at + step + count) % count], &error))
        view_say(s, "%s", error.text);
}

/* --- camera and window ------------------------------------------------------------------------ */

static void frame_all(view_state *s, int unused) {
    (void)unused;
    view_frame_box(s, s->world->minimum, s->world->maximum);
}

static void first_camera(view_state *s, int unused) {
    (void)unused;
    view_use_default_camera(s);
}

void view_use_camera(view_state *s, int index) {
    s->camera = index;
    s->now.camera = s->world->cameras[index];
    view_say(s, "Camera: %s", s->now.camera.name);
}

static void next_camera(view_state *s, int step) {
    if (s->world->camera_count > 0)
        view_use_camera(s, (s->camera + step) % (int)s->world->camera_count);
    else
        first_camera(s, 0);
}

/* What an action switches or requests, by its offset in the state. */
#define SWITCH(flag)  toggle, offsetof(view_state, flag)
#define REQUEST(what) request, offsetof(view_state, requests.what)

static bool *flag_at(const view_state *s, int offset) {
    return (bool *)((char *)(uintptr_t)s + offset);
}

static void toggle(view_state *s, int flag) {
    *flag_at(s, flag) = !*flag_at(s, flag);
}

static void request(view_state *s, int what) {
    *flag_at(s, what) = true;
}

/* Switches the framing, as --framing inside and outside do. */
static void toggle_framing(view_state *s, int unused) {
    (void)unused;
    s->walking = !s->walking;
    s->now.camera = scene_framed_camera(
        s->world, s->walking ? SCENE_FRAMING_INSIDE : SCENE_FRAMING_OUTSIDE, view_aspect(&s->now));
    view_say(s, s->walking ? "Inside: the left button looks around"
                           : "Outside: the left button goes around");
}

static void step_back(view_state *s, int unused) {
    (void)unused;
    if (s->help)
        s->help = false;
    else if (s->selected >= 0)
        s->selected = -1;
    else if (s->node >= 0)
        s->node = -1;
    else
        s->requests.cancel = true;
}

const view_key view_keys[] = {
    { NULL, "Files", NULL, NULL, 0, NULL },
    { "Ctrl+O", "Ctrl O, drop a file", "scene, lights, material", view_ask_file, 0, "Open" },
    { "F12", "F12  P", "screenshot with its settings", REQUEST(shot), "Screenshot" },
    { "p", NULL, NULL, REQUEST(shot), NULL },
    { "Ctrl+C", "Ctrl C", "screenshot, and the command for it", REQUEST(command), "Copy command" },
    { "Ctrl+S", "Ctrl S", "the lights as a file", REQUEST(save), "Export lights" },
    { "Ctrl+E", "Ctrl E", "a copy of the glTF with them", REQUEST(copy), "Export scene" },
    { "Ctrl+R", "Ctrl R", "camera, lights as you left them", REQUEST(resume), "Last session" },

    { NULL, "Scene", NULL, NULL, 0, NULL },
    { "Ctrl+T", "Ctrl T", "select the node pointed at", view_pick_node, 0, "Pick" },
    { "Ctrl+F", "Ctrl F", "frame it", view_frame_node, 0, "Frame the node" },
    { "Ctrl+K", "Ctrl K", "hide it, show it again", view_hide_node, 0, "Hide" },
    { "Ctrl+I", "Ctrl I", "hide all others", view_isolate_node, 0, "Isolate" },
    { "Ctrl+U", "Ctrl U", "show all", view_show_nodes, 0, "Show all" },

    { NULL, "Camera", NULL, NULL, 0, NULL },
    { NULL, "left drag", "go around, inside look around", NULL, 0, NULL },
    { NULL, "Shift + left, middle drag", "pan", NULL, 0, NULL },
    { NULL, "right drag", "look around", NULL, 0, NULL },
    { NULL, "wheel", "nearer, farther", NULL, 0, NULL },
    { NULL, "W A S D  Q E", "fly (Shift: faster)", NULL, 0, NULL },
    { "F2", "F2", "see it from inside, from outside", toggle_framing, 0, "Inside, outside" },
    { "f", "F", "frame everything", frame_all, 0, "Frame everything" },
    { "F", "Shift F", "frame the selected light", view_frame_light, 0, "Frame the light" },
    { "c", "C", "next camera of the scene", next_camera, 1, "Next camera" },
    { "Home", "Home", "first camera", first_camera, 0, "First camera" },

    { NULL, "Shading", NULL, NULL, 0, NULL },
    { "m", "M", "method", change_method, 1, "Next method" },
    { "M", NULL, NULL, change_method, -1, "Previous method" },
    { "Up", "Up  Down", "bands, one by one", change_bands, 1, "More bands" },
    { "Down", NULL, NULL, change_bands, -1, "Fewer bands" },
    { "Page_Up", "Page Up  Page Down", "bands, ten by ten", change_bands, 10, "10 bands more" },
    { "Page_Down", NULL, NULL, change_bands, -10, "10 bands fewer" },
    { "g", "G", "windowing filter", change_window, 1, "Next filter" },
    { "G", NULL, NULL, change_window, -1, "Previous filter" },
    { ",", ",  .", "darker, brighter by 1/3 stop", change_exposure, -1, "Darker" },
    { ".", NULL, NULL, change_exposure, 1, "Brighter" },
    { "0", "0", "exposure to suit the image", REQUEST(expose), "Expose" },
    { "u", "U", "tone curve", change_tone, 1, "Next tone curve" },
    { "U", NULL, NULL, change_tone, -1, "Previous tone curve" },
    { "z", "Z", "shadows on, off", toggle_shadows, 0, "Shadows" },
    { "Z", "Shift Z", "light that bounces on, off", toggle_bounces, 8, "Bounces" },

    { NULL, "Materials", NULL, NULL, 0, NULL },
    { "t", "T", "material of the object pointed at", change_material, 1, "Next material" },
    { "T", NULL, NULL, change_material, -1, "Previous material" },
    { "Enter", "Enter", "values of the light, of materials", view_toggle_panel, 0, "Values" },
    { "Ctrl+Z", "Ctrl Z  Ctrl Y", "undo, redo lights, materials, hiding", view_undo, -1, "Undo" },
    { "Ctrl+Y", NULL, NULL, view_undo, 1, "Redo" },

    { NULL, "Compare", NULL, NULL, 0, NULL },
    { "v", "V", "split; drag the divider", split, GPU_SPLIT_DIVIDED, "Split" },
    { "x", "X", "difference of both sides", split, GPU_SPLIT_DIFFERENCE, "Difference" },
    { "y", "Y", "swap both sides", swap_sides, 0, "Swap sides" },

    { NULL, "Lights", NULL, NULL, 0, NULL },
    { NULL, "left drag on one", "move it (wheel: in depth)", NULL, 0, NULL },
    { "Ctrl+H", "Ctrl H", "handles on, off (Ctrl: by steps)", SWITCH(handles), "Handles" },
    { "Tab", "Tab", "select the next", view_select_light, 1, "Next light" },
    { "Shift+Tab", NULL, NULL, view_select_light, -1, "Previous light" },
    { "n", "N", "new, over what is pointed at", view_add_light, 0, "Add light" },
    { "Ctrl+D", "Ctrl D", "a copy beside the selected", view_copy_light, 0, "Copy light" },
    { "Ctrl+M", "Ctrl M", "mute the selected, or not", view_mute_light, 0, "Mute" },
    { "Ctrl+L", "Ctrl L", "mute all others, or not", view_solo_light, 0, "Solo" },
    { "Delete", "Delete", "remove the selected", view_remove_light, 0, "Delete light" },
    { "Backspace", NULL, NULL, view_remove_light, 0, NULL },
    { "[", "[  ]", "smaller, larger (same power)", view_resize_lights, -1, "Smaller" },
    { "]", NULL, NULL, view_resize_lights, 1, "Larger" },
    { "-", "-  +", "dimmer, brighter", view_brighten_lights, -1, "Dim" },
    { "+", NULL, NULL, view_brighten_lights, 1, "Brighten" },
    { "=", NULL, NULL, view_brighten_lights, 1, NULL },
    { "h", "H", "hue", view_recolor_lights, 1, "Next hue" },
    { "H", NULL, NULL, view_recolor_lights, -1, "Previous hue" },
    { "k", "K", "kind: sphere, point, spot, …", view_change_kind, 1, "Next kind" },
    { "K", NULL, NULL, view_change_kind, -1, "Previous kind" },
    { "l", "L", "direction: to what is pointed at", view_direct_light, 0, "Direct" },
    { "1", "1  2  3", "drag: reflection, illumination, rim", view_choose_aim, VIEW_AIM_REFLECTION,
      "Reflection" },
    { "2", NULL, NULL, view_choose_aim, VIEW_AIM_ILLUMINATION, "Illumination" },
    { "3", NULL, NULL, view_choose_aim, VIEW_AIM_RIM, "Rim" },
    { "L", "Shift L", "which ones make what is pointed at", REQUEST(shares), "Shares" },
    { "j", "J  Shift J", "paler, purer", view_fade_lights, 1, "Paler" },
    { "J", NULL, NULL, view_fade_lights, -1, "Purer" },
    { NULL, "", "none selected: all of them", NULL, 0, NULL },

    { NULL, "Time", NULL, NULL, 0, NULL },
    { "space", "Space", "play, pause", SWITCH(playing), "Play, pause" },
    { "o", "O", "next path: orbit, bounce, …", change_path, 1, "Next path" },
    { "Left", "Left  Right", "one frame back, forward", step_time, -1, "Frame back" },
    { "Right", NULL, NULL, step_time, 1, "Frame forward" },
    { "b", "B", "back to the start", rewind_time, 0, "To the start" },

    { NULL, "Window", NULL, NULL, 0, NULL },
    { "r", "R", "record an image sequence", REQUEST(record), "Record" },
    { "i", "I", "statistics on, off", SWITCH(overlay), "Statistics" },
    { "F5", "F5", "read the scene again", REQUEST(reload), "Read again" },
    { "Shift+F5", "Shift F5", "start the graphics again", REQUEST(restart),
      "Restart the graphics" },
    { "F3", "F3", "panel at the side on, off", SWITCH(sidebar), "Panel" },
    { "F11", "F11", "full screen", REQUEST(fullscreen), "Full screen" },
    { "F1", "F1  ?", "this help", SWITCH(help), "Help" },
    { "?", NULL, NULL, SWITCH(help), NULL },
    { "Escape", "Escape", "close the help, deselect, cancel", step_back, 0, "Close, deselect" },
    { "Ctrl+B", "Ctrl B", "cancel drawing it finer, tables", REQUEST(cancel), "Cancel" },
    { "Ctrl+Q", "Ctrl Q", "quit", REQUEST(quit), "Quit" },
    { NULL, NULL, NULL, NULL, 0, NULL },
};

const view_key *view_find_key(const char *key) {
    for (const view_key *row = view_keys; row->key || row->shown; row++)
        if (row->key && strcmp(row->key, key) == 0)
            return row;
    return NULL;
}

const view_key *view_find_action(const char *name) {
    for (const view_key *row = view_keys; row->key || row->shown; row++)
        if (row->name && strcmp(row->name, name) == 0)
            return row;
    return NULL;
}

bool view_is_end(const view_key *row) {
    const size_t what = (size_t)row->argument;
    return row->act == step_back ||
           (row->act == request && (what == offsetof(view_state, requests.quit) ||
                                    what == offsetof(view_state, requests.cancel)));
}

bool view_is_heading(const view_key *row) {
    return row->shown && !row->help;
}

bool view_is_on(const view_state *s, const view_key *row) {
    if (row->act == toggle)
        return *flag_at(s, row->argument);
    if (row->act == view_choose_aim)
        return s->aim == (view_aim)row->argument;
    if (row->act == split)
        return s->now.split == (gpu_split)row->argument;
    return (row->act == toggle_shadows && s->now.shadows) ||
           (row->act == toggle_bounces && s->now.bounces > 0);
}
