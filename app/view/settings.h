/* SPDX-License-Identifier: MIT */
/* settings.h - everything that decides an image of the viewer, and the same as JSON: in the text
 * chunk of a screenshot, and for `lampion render --from` (docs/viewer.md). */
#ifndef LAMPION_VIEW_SETTINGS_H
#define LAMPION_VIEW_SETTINGS_H

#include "app/environment/environment.h"
#include "app/render/gl/gpu.h"

#include <stddef.h>

#define VIEW_PATH_SIZE     1024
#define VIEW_MATERIAL_SIZE (VIEW_PATH_SIZE + SCENE_NAME_SIZE)
#define VIEW_SAMPLES_MAX   1024

/* How to shade a side. */
typedef struct view_shading {
    method_kind method;
    int bands;
    lmp_window window;
} view_shading;

typedef struct view_settings {
    char scene[VIEW_PATH_SIZE];
    int up;                        /* as in scene_options */
    char variant[SCENE_NAME_SIZE]; /* likewise; empty: the file's own */
    int width, height;
    int samples; /* a pixel */
    bool shadows;
    int ground;     /* environment_ground */
    float exposure; /* a factor on radiance */
    int tone;       /* a row of image_tones */
    float background[3];
    char environment[VIEW_PATH_SIZE]; /* a name of environment_options */
    float environment_rotation, environment_strength;
    double origin[3]; /* in the world: camera and lights are relative to it, as the scene's are */
    scene_camera camera;
    view_shading shading[2]; /* the second one of a split image */
    gpu_split split;
    float divider; /* a part of the width */
    int material_count;
    char materials[RENDER_TABLES_MAX][VIEW_MATERIAL_SIZE]; /* NAME=MATERIAL */
    size_t light_count;
    scene_light lights[SCENE_LIGHTS_MAX];
} view_settings;

/* As scene_options has it. */
static inline const char *view_variant(const view_settings *settings) {
    return settings->variant[0] ? settings->variant : NULL;
}

/* The bytes of them that count: all but the room for more lights. */
static inline size_t view_settings_size(const view_settings *settings) {
    return offsetof(view_settings, lights) + settings->light_count * sizeof *settings->lights;
}

extern const char *const view_split_names[GPU_SPLITS + 1]; /* NULL-terminated */

/* Has materials of that name replaced by another, as --material has it, or with NULL by nothing.
 * False if there is no room or the names are too long. */
bool view_set_material(view_settings *settings, const char *material_name, const char *replacement);

/* What replaces it, or NULL. */
const char *view_material_of(const view_settings *settings, const char *material_name);

/* Takes camera and lights to another origin. */
void view_settings_rebase(view_settings *settings, const double origin[3]);

struct cJSON;
struct cJSON *view_settings_to_json(const view_settings *settings);

/* Every number is checked; *settings is zero on failure, whose line names the `subject`. */
bool view_settings_from_json(const struct cJSON *root, const char *subject, view_settings *settings,
                             cli_error *error);

/* An image with its settings in a text chunk. */
bool view_write_shot(const view_settings *settings, const unsigned char *rgb8, const char *path,
                     cli_error *error);

/* What the reader of a screenshot allows it, and names in place of what it names. */
typedef struct view_shot_options {
    int pixels_max;
    bool allow_paths;          /* of files that do not lie beside it */
    const char *scene;         /* or NULL; this one and those of the materials */
    const cli_list *materials; /* may lie anywhere; or NULL */
} view_shot_options;

/* The settings of such an image. They name no files but those that the options allow. */
bool view_read_shot(const char *path, const view_shot_options *options, view_settings *settings,
                    cli_error *error);

/* The rows of a command that say so: how many pixels a screenshot may ask for, by default
 * IMAGE_READ_PIXELS, and whether it may name any file. */
#define VIEW_SHOT_OPTION_ROWS(shot)                                                                \
    { .name = "max-pixels",                                                                        \
      .kind = CLI_INT,                                                                             \
      .target = &(shot).pixels_max,                                                                \
      .argument = "N",                                                                             \
      .help = "refuse a screenshot of more pixels, each of which takes 97 to 444 bytes of memory", \
      .minimum = 1,                                                                                \
      .maximum = IMAGE_PIXELS_MAX },                                                               \
    {                                                                                              \
        .name = "allow-paths", .kind = CLI_FLAG, .target = &(shot).allow_paths,                    \
        .help = "let a screenshot name files outside the folder it lies in"                        \
    }

#endif
