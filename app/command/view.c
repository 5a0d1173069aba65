/* SPDX-License-Identifier: MIT */
#include "app/view/view.h"
#include "app/base/cli.h"
#include "app/command/command.h"
#include "app/render/renderer/bounces.h"
#include "app/render/renderer/override.h"
#include "app/render/renderer/shadows.h"
#include "app/scene/animation.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES_MAX = 100000000 };

/* The options of the command line that do not go directly into the settings. */
typedef struct view_arguments {
    int size[2], bands, method_choice, window;
    method_kind method;
    float exposure, stops;
    bool exposure_given;
    int tone;
    const char *from;
    cli_list materials;
    shadow_options shadow; /* whether shadows are cast */
    int bounces;
    view_shot_options shot; /* for `from` */
} view_arguments;

/* Adds NAME=MATERIAL to the settings; drawing finds out whether the scene has a material of that
 * name. */
static bool add_materials(const cli_list *list, view_settings *settings, base_error *error) {
    for (int i = 0; i < list->count; i++) {
        const char *text = list->items[i], *equals = strchr(text, '=');
        char name[SCENE_NAME_SIZE] = "";
        if (!equals)
            return base_fail(error, text, "--material is NAME=MATERIAL");
        if ((size_t)(equals - text) >= sizeof name)
            return base_fail(error, text, "no material has so long a name");
        memcpy(name, text, (size_t)(equals - text));
        if (!view_set_material(settings, name, equals + 1))
            return base_fail(error, text, "is too long a name, or one material too many");
    }
    return true;
}

static bool fill_options(const view_arguments *a, const char *name, view_options *o,
                         base_error *error) {
    view_settings *s = &o->settings;
    if (a->from) {
        view_shot_options allowed = a->shot;
        allowed.scene = name;
        allowed.materials = &a->materials;
        if (!view_read_shot(a->from, &allowed, s, error))
            return false;
        o->keep_lights = true;
        o->load.up = s->up;
        o->load.leaves = s->leaves;
        o->load.variant = view_variant(s);
    } else {
        s->up = o->load.up;
        s->leaves = o->load.leaves;
        s->tone = a->tone;
        s->exposure = (a->exposure_given ? a->exposure : 1) * image_exposure_of_stops(a->stops);
        o->expose = !a->exposure_given;
        o->camera_wanted = true;
        s->width = a->size[0];
        s->height = a->size[1];
        s->shadows = a->shadow.on && !a->shadow.off;
        o->shadows_chosen = a->shadow.on || a->shadow.off;
        s->bounces = a->bounces;
        s->divider = 0.5f;
        s->shading[0] = (view_shading) { a->method, a->bands, (lmp_window)a->window };
        s->shading[1] = s->shading[0];
    }
    if (!a->from && o->load.variant) {
        if (strlen(o->load.variant) >= sizeof s->variant)
            return base_fail(error, o->load.variant, "no variant has so long a name");
        strcpy(s->variant, o->load.variant);
    }
    if (name) {
        if (strlen(name) >= sizeof s->scene)
            return base_fail(error, name, "is too long a name");
        strcpy(s->scene, name);
    }
    return add_materials(&a->materials, s, error);
}

/* Checks what the table of options cannot express. */
static int check_arguments(const cli_command *command, const view_arguments *a, int operand_count) {
    const int most = method_table[a->method].bands_max[DEVICE_AUTO];
    if (operand_count > 1 || (operand_count == 0 && !a->from))
        return cli_usage(command, "one SCENE is needed, %d given", operand_count);
    if (a->bands > most)
        return cli_usage(command, "--bands %d: %s takes 1 to %d", a->bands,
                         method_table[a->method].name, most);
    return BASE_OK;
}

static int view(const view_arguments *a, const char *name, view_options *o) {
    base_error error = { "" };
    return fill_options(a, name, o, &error) && view_run(o, &error) ? BASE_OK : base_report(&error);
}

static const view_arguments defaults = { .size = { 1280, 720 },
                                         .bands = LMP_SHADE_BANDS_DEFAULT,
                                         .window = LMP_WINDOW_HANNING,
                                         .shot.pixels_max = IMAGE_READ_PIXELS };

static int run(const cli_command *command, int argc, char **argv) {
    view_arguments a = defaults;
    view_options *o = calloc(1, sizeof *o);
    if (!o) {
        base_error error;
        base_fail(&error, NULL, "out of memory");
        return base_report(&error);
    }
    o->fps = 24;
    o->settings.samples = 8;
    o->environment.strength = 1;
    const cli_option options[] = {
        { "size", 's', CLI_SIZE, a.size, "WxH", "of the window", 1, 8192, NULL, NULL },
        { "bands", 'n', CLI_INT, &a.bands, "N", "bands of spherical harmonics", 1, LMP_BANDS_MAX,
          NULL, NULL },
        METHOD_OPTION_ROW(a.method_choice),
        { "window", 0, CLI_CHOICE, &a.window, "WINDOW",
          "windowing filter: damps the ringing of a series of few bands", 0, 0,
          method_window_names(), NULL },
        SHADOW_SWITCH_ROWS(a.shadow, SHADOW_SUITS " or a GPU draws"),
        BOUNCES_OPTION_ROW(a.bounces),
        SCENE_LIGHTS_OPTION_ROWS(o->lights),
        ENVIRONMENT_OPTION_ROWS(o->environment),
        ENVIRONMENT_GROUND_ROW(o->environment),
        SCENE_CAMERA_OPTION_ROWS(o->camera, o->load),
        SCENE_LOAD_OPTION_ROWS(o->load),
        OVERRIDE_OPTION_ROW(a.materials),
        IMAGE_DISPLAY_OPTION_ROWS(a.exposure, a.exposure_given, a.stops, a.tone),
        { "samples", 0, CLI_INT, &o->settings.samples, "N", "samples per pixel, when nothing moves",
          1, VIEW_SAMPLES_MAX, NULL, NULL },
        { "animate", 0, CLI_TEXT, &o->animate, ANIMATION_ARGUMENT,
          "play how lights move: " ANIMATION_NAMES "; without it they wait for the space bar", 0, 0,
          NULL, NULL },
        { "from", 0, CLI_TEXT, &a.from, "FILE",
          "begin with all settings of a screenshot; of the options, --material and those after it "
          "count",
          0, 0, NULL, NULL },
        VIEW_SHOT_OPTION_ROWS(a.shot),
        { "record", 0, CLI_TEXT, &o->record, "DIR", "write every frame into DIR, numbered", 0, 0,
          NULL, NULL },
        { "script", 0, CLI_TEXT, &o->script, "FILE",
          "timed events to play; lampion-formats(5) has them", 0, 0, NULL, NULL },
        { "fps", 0, CLI_FLOAT, &o->fps, "RATE", "frames per second of --record and --script", 0.01,
          1000, NULL, NULL },
        { "state", 0, CLI_TEXT, &o->state, "FILE",
          "keep the settings in FILE, as JSON, every frame", 0, 0, NULL, NULL },
        { "frames", 0, CLI_INT, &o->frames, "N", "quit after so many frames; 0 means never", 0,
          FRAMES_MAX, NULL, NULL },
        { .name = NULL },
    };
    int operand_count, status;
    char **operands;
    if (cli_parse(command, options, argc, argv, &operand_count, &operands, &status)) {
        a.method = method_chosen(a.method_choice, a.bands);
        status = check_arguments(command, &a, operand_count);
        if (status == BASE_OK)
            status = view(&a, operand_count ? operands[0] : NULL, o);
    }
    free(o);
    return status;
}

const cli_command command_view = {
    .name = "view",
    .operands = "SCENE",
    .summary = "look at a scene in a window, move and change its lights",
    .examples = "lampion view builtin:atrium\n"
                "lampion view scene.glb --random-lights 30 --animate orbit\n"
                "lampion view --from lampion-0001.png\n"
                "lampion view builtin:balls --script demo.txt --record frames\n",
    .run = run,
    .kernels = true,
};
