/* SPDX-License-Identifier: MIT */
/* settings.h - everything that determines an image of the viewer, and its JSON form: in the text
 * chunk of a screenshot, and for `lampion render --from` (docs/viewer.md). */
#ifndef LAMPION_VIEW_SETTINGS_H
#define LAMPION_VIEW_SETTINGS_H

#include "app/base/cli.h"
#include "app/render/gl/gpu.h"
#include "app/scene/environment.h"

#include <stddef.h>

#define VIEW_PATH_SIZE     1024
#define VIEW_MATERIAL_SIZE (VIEW_PATH_SIZE + SCENE_NAME_SIZE)
#define VIEW_SAMPLES_MAX   1024

/* How a side is shaded. */
typedef struct view_shading {
    method_kind method;
    int bands;
    lmp_window window;
} view_shading;

/* Instances of the scene, by their numbers. */
enum { VIEW_HIDDEN_MAX = 256 };
typedef struct view_range {
    uint32_t first, last;
} view_range;

typedef struct view_hidden {
    int count;
    view_range ranges[VIEW_HIDDEN_MAX]; /* ascending, apart (nodes.h) */
} view_hidden;

/* The environment, as in environment_options. */
typedef struct view_environment {
    char name[VIEW_PATH_SIZE];
    float rotation, strength;
    int ground; /* environment_ground */
} view_environment;

/* The replaced materials of the scene. */
typedef struct view_replacements {
    int count;
    char texts[RENDER_TABLES_MAX][VIEW_MATERIAL_SIZE]; /* NAME=MATERIAL */
} view_replacements;

typedef struct view_settings {
    char scene[VIEW_PATH_SIZE];
    int up, leaves;                /* as in scene_options */
    char variant[SCENE_NAME_SIZE]; /* as in scene_options; empty: the file's default */
    int width, height;
    int samples; /* per pixel */
    bool shadows;
    int bounces;    /* of light between surfaces; 0: none */
    float exposure; /* a factor on radiance */
    int tone;       /* a row of image_tones */
    float background[3];
    view_environment environment;
    double origin[3]; /* in the world; camera and lights are relative to it, as the scene's are */
    scene_camera camera;
    view_shading shading[2]; /* the second is for a split image */
    gpu_split split;
    float divider;      /* as a fraction of the width */
    view_hidden hidden; /* what follows is edited, undone and redone */
    view_replacements materials;
    size_t light_count;
    scene_light lights[SCENE_LIGHTS_MAX];
} view_settings;

/* --- members: one row of a table says how each is read, written, set and shown ------------------
 */

typedef enum view_type {
    VIEW_FLAG,    /* bool */
    VIEW_INTEGER, /* int */
    VIEW_CHOICE,  /* int or an enumeration: the index of a name */
    VIEW_FLOAT,
    VIEW_FLOATS, /* three */
    VIEW_POINT,  /* float[3], in the world in JSON */
    VIEW_ORIGIN, /* double[3] */
    VIEW_FILE,   /* char[VIEW_PATH_SIZE], but never standard input */
    VIEW_TEXT,   /* char[SCENE_NAME_SIZE] */
    VIEW_OBJECT,
    VIEW_ARRAY, /* an object for each side */
    VIEW_HIDDEN,
    VIEW_MATERIALS,
    VIEW_LIGHTS
} view_type;

/* What else there is to a member, as bits. */
enum {
    VIEW_OPTIONAL = 1, /* screenshots of early versions lack it */
    VIEW_UNUSUAL = 2,  /* written only where it is not what it is when absent */
    VIEW_FIXED = 4     /* not set by its path */
};

typedef struct view_member {
    const char *name; /* in its object; NULL ends a list */
    view_type type;
    size_t offset; /* of its value in the settings */
    unsigned traits;
    double range[2];
    int absent; /* the value of a choice that is absent; all else is 0 then */
    const char *const *choices, *const *(*list)(void); /* of VIEW_CHOICE; list: returns them */
    const struct view_member *members;                 /* of objects and arrays */
} view_member;

/* Finds the member of a path, such as "looks/0/bands"; returns NULL if nothing of that name can be
 * set. */
const view_member *view_find_member(const char *path);

/* Returns the names that a choice is from, NULL-terminated. */
const char *const *view_choices(const view_member *member);

struct json_t;

/* Reads the value of a member. If it is out of range, what can be set stays as it was. */
bool view_read_member(const view_member *member, struct json_t *item, view_settings *settings);

/* --- all of them ------------------------------------------------------------------------------ */

/* Returns the most bands that the method of a side has; the other function takes back more. */
int view_bands_max(const view_shading *shading);
void view_hold_bands(view_shading *shading);

/* Whether a side's method reads preintegrated lobes and materials. */
static inline bool view_is_preintegrated(const view_shading *shading) {
    return method_table[shading->method].reads & METHOD_READS_PREINTEGRATED;
}

/* Returns how many sides the image has. */
static inline int view_sides(const view_settings *settings) {
    return settings->split == GPU_SPLIT_NONE ? 1 : 2;
}

/* Returns the image's width in relation to its height. */
static inline float view_aspect(const view_settings *settings) {
    return (float)settings->width / (float)settings->height;
}

/* Returns the variant as in scene_options. */
static inline const char *view_variant(const view_settings *settings) {
    return settings->variant[0] ? settings->variant : NULL;
}

/* Returns the size of the settings in use: all but the room for more lights. */
static inline size_t view_settings_size(const view_settings *settings) {
    return offsetof(view_settings, lights) + settings->light_count * sizeof *settings->lights;
}

/* Returns the index of a name among others, ended by NULL, or -1. */
int view_find_name(const char *const *names, const char *name);

extern const char *const view_split_names[GPU_SPLITS + 1]; /* NULL-terminated */

/* Replaces materials of that name by another, as --material does, or removes the replacement if
 * NULL. Returns false if there is no room or the names are too long. */
bool view_set_material(view_settings *settings, const char *material_name, const char *replacement);

/* Returns the replacement of a material, or NULL. */
const char *view_material_of(const view_settings *settings, const char *material_name);

/* Moves camera and lights to another origin. */
void view_settings_rebase(view_settings *settings, const double origin[3]);

struct json_t *view_settings_to_json(const view_settings *settings);

/* Reads and checks every number; on failure *settings is zero, and the message names the
 * `subject`. Before, *settings must be zero or hold settings, because to clear the room for all
 * lights takes longer than to read most files. */
bool view_settings_from_json(const struct json_t *root, const char *subject,
                             view_settings *settings, base_error *error);

/* Writes an image with its settings in a text chunk. */
bool view_write_shot(const view_settings *settings, const unsigned char *rgb8, const char *path,
                     base_error *error);

/* What a screenshot may request, and names that replace those in it. */
typedef struct view_shot_options {
    int pixels_max;
    bool allow_paths;          /* of files that do not lie beside it */
    const char *scene;         /* replaces its scene, or NULL */
    const cli_list *materials; /* replace its materials and may lie anywhere; or NULL */
} view_shot_options;

/* Reads the settings of a screenshot, which name no files but those that the options allow; before,
 * *settings must be zero or hold settings. */
bool view_read_shot(const char *path, const view_shot_options *options, view_settings *settings,
                    base_error *error);

/* Whether a screenshot at this path may name all files that the settings name, without
 * allow_paths. */
bool view_shot_confines(const view_settings *settings, const char *path);

/* The option rows of a command that reads screenshots: how many pixels one may request, by default
 * IMAGE_READ_PIXELS, and whether it may name any file. */
#define VIEW_SHOT_OPTION_ROWS(shot)                                                                \
    { .name = "max-pixels",                                                                        \
      .kind = CLI_INT,                                                                             \
      .target = &(shot).pixels_max,                                                                \
      .argument = "N",                                                                             \
      .help = "refuse a screenshot of more pixels, each of which takes 97 to 480 bytes of memory", \
      .minimum = 1,                                                                                \
      .maximum = IMAGE_PIXELS_MAX },                                                               \
    {                                                                                              \
        .name = "allow-paths", .kind = CLI_FLAG, .target = &(shot).allow_paths,                    \
        .help = "let a screenshot name files outside the folder it lies in"                        \
    }

#endif
