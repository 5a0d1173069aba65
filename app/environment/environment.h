/* SPDX-License-Identifier: MIT */
/* environment.h - ambient light from far away: an image of it, or the built-in studio. */
#ifndef LAMPION_ENVIRONMENT_H
#define LAMPION_ENVIRONMENT_H

#include "app/image/image.h"
#include "app/scene/scene.h"

/* Whether shadows fall on level ground under the scene; as suits: in the studio, seen from outside.
 */
typedef enum environment_ground {
    ENVIRONMENT_GROUND_SUITS,
    ENVIRONMENT_GROUND_ON,
    ENVIRONMENT_GROUND_OFF
} environment_ground;

typedef struct environment_options {
    const char *name; /* a file, "studio" or "none"; NULL: the studio where nothing else shines */
    float rotation;   /* degrees, counter-clockwise as seen from above */
    float strength;   /* a factor on radiance */
    int ground;       /* environment_ground */
} environment_options;

#define ENVIRONMENT_DEFAULTS                                                                       \
    { .strength = 1 }
#define ENVIRONMENT_STRENGTH_MAX 1e6

/* The rows of a command's option table that fill an environment_options variable, which begins as
 * ENVIRONMENT_DEFAULTS. */
#define ENVIRONMENT_OPTION_ROWS(variable)                                                          \
    { .name = "environment",                                                                       \
      .kind = CLI_TEXT,                                                                            \
      .target = &(variable).name,                                                                  \
      .argument = "FILE",                                                                          \
      .help = "ambient light: a .hdr, .exr or .png of the surroundings, studio, or none; "         \
              "without it, studio where little else shines" },                                     \
        { .name = "environment-rotation",                                                          \
          .kind = CLI_FLOAT,                                                                       \
          .target = &(variable).rotation,                                                          \
          .argument = "DEGREES",                                                                   \
          .help = "rotate the environment counter-clockwise, as seen from above",                  \
          .minimum = -360,                                                                         \
          .maximum = 360 },                                                                        \
    {                                                                                              \
        .name = "environment-strength", .kind = CLI_FLOAT, .target = &(variable).strength,         \
        .argument = "FACTOR", .help = "multiply the radiance of the environment by this",          \
        .minimum = 0, .maximum = ENVIRONMENT_STRENGTH_MAX                                          \
    }

/* And of the ground, where a command casts shadows. */
extern const char *const environment_ground_names[];
#define ENVIRONMENT_GROUND_ROW(variable)                                                           \
    {                                                                                              \
        .name = "ground", .kind = CLI_CHOICE, .target = &(variable).ground, .argument = "WHETHER", \
        .help = "let shadows fall on level ground under the scene, which is not seen itself; "     \
                "auto is on in the built-in studio, seen from outside",                            \
        .choices = environment_ground_names                                                        \
    }

#define ENVIRONMENT_SUNS_MAX 8

/* Both images are latitude-longitude, as lmp_latlong has them. Zero: there is none. */
typedef struct environment {
    image light;    /* its radiance */
    image backdrop; /* what is seen of it; without pixels: nothing */
    float azimuth;  /* of the center columns, radians from +x toward +z */
    bool studio;    /* it is the built-in one */
    bool ground;    /* shadows fall on level ground under the scene */
    size_t faint;   /* lights of the scene that it outshines */
    float *sh;      /* its coefficients, lmp_environment, of `bands` bands */
    int bands;
    scene_light suns[ENVIRONMENT_SUNS_MAX]; /* what environment_extract_suns took from `light` */
    int sun_count;
} environment;

/* Whether a name is that of a file, not of what is built in. */
bool environment_is_file(const char *name);

/* Whether the scene has lights of its own, and more than what glows in a corner of it. */
bool environment_lights_suffice(const scene *world);

/* What the options name for a scene: without a name the studio, with a note on stderr, or none. */
const char *environment_choose(const environment_options *options, const scene *world);

/* Opens what the options name for a scene. */
bool environment_open(const environment_options *options, const scene *world, environment *e,
                      cli_error *error);
void environment_free(environment *e);

static inline bool environment_shines(const environment *e) {
    return e && e->light.rgb;
}

/* Takes small bright parts of a file's image, such as a sun, out of its light, and makes hidden
 * caps of them: bands would ring, caps are exact and cast shadows. The backdrop keeps them. */
bool environment_extract_suns(environment *e, cli_error *error);

/* Puts them behind `count` lights, of SCENE_LIGHTS_MAX; returns how many there are then. */
size_t environment_add_suns(const environment *e, scene_light *lights, size_t count);

/* The exposure that suits a scene that nothing but the studio lights, but for what glows; else 0:
 * find one. */
static inline float environment_exposure(const environment *e, size_t light_count) {
    return e && e->studio && light_count <= e->faint ? 1 : 0;
}

/* Whether shadows suit a scene by default. Not where the studio lights one that is seen from
 * inside: it stands for the light that such a room would have, and its walls would keep all of it
 * out. */
static inline bool environment_suits_shadows(bool studio, const scene *seen) {
    return !(studio && scene_is_inside(seen));
}

/* Makes its coefficients, of so many bands at least. */
bool environment_project(environment *e, int bands, cli_error *error);

/* Where a direction of any length falls on its images, 0 … 1 across and down, by arithmetic whose
 * bits are the same everywhere. */
void environment_place(const environment *e, const float direction[3], float *across, float *down);

/* What is seen of it in a direction of any length, interpolated between pixels; backdrop.glsl does
 * the same. */
lmp_rgb environment_seen(const environment *e, const float direction[3]);

/* The built-in studio, and what is seen of it: a hemisphere with soft boxes, whose front is the
 * center column. */
bool environment_make_studio(environment *e, cli_error *error);

/* Spreads a cube map, the unfolded cross of 4 x 3 or 3 x 4 faces, over a latitude-longitude image;
 * *map is created. The middle of the cross is what a camera that looks along -z sees. */
bool environment_unfold(const image *cross, image *map, cli_error *error);

#endif
