/* SPDX-License-Identifier: MIT */
/* environment.h - light from far away in all directions: a file's image, or the built-in studio. */
#ifndef LAMPION_SCENE_ENVIRONMENT_H
#define LAMPION_SCENE_ENVIRONMENT_H

#include "app/base/cli.h"
#include "app/image/image.h"
#include "app/scene/scene.h"

/* Whether shadows fall on level ground under the scene; AUTO: in the studio, seen from outside. */
typedef enum environment_ground {
    ENVIRONMENT_GROUND_SUITS,
    ENVIRONMENT_GROUND_ON,
    ENVIRONMENT_GROUND_OFF
} environment_ground;

typedef struct environment_options {
    const char *name; /* a file, "studio" or "none"; NULL: what environment_choose says */
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
              "without it, studio where little but suns shines" },                                 \
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

/* The names of environment_ground, for the option of a command that casts shadows. */
extern const char *const environment_ground_names[];
#define ENVIRONMENT_GROUND_ROW(variable)                                                           \
    {                                                                                              \
        .name = "ground", .kind = CLI_CHOICE, .target = &(variable).ground, .argument = "WHETHER", \
        .help = "let shadows fall on level ground under the scene, which is not seen itself; "     \
                "auto is on in the built-in studio, seen from outside",                            \
        .choices = environment_ground_names                                                        \
    }

#define ENVIRONMENT_SUNS_MAX 8

/* The environment. Both images are latitude-longitude, as in lmp_latlong. Zero: no environment. */
typedef struct environment {
    image light;    /* what lights the scene: radiance */
    image backdrop; /* what is seen of it; without pixels: nothing */
    float azimuth;  /* of the center column, radians from +x toward +z */
    bool studio;    /* whether it is the built-in studio */
    bool ground;    /* whether shadows fall on level ground under the scene */
    size_t faint;   /* number of the scene's lights that it outshines */
    float exposure; /* that suits it beside no other lights; 0: determine one */
    float *sh;      /* coefficients as in lmp_environment, of `bands` bands */
    int bands;
    scene_light suns[ENVIRONMENT_SUNS_MAX]; /* that environment_extract_suns took from `light` */
    int sun_count;
} environment;

/* Whether a name is that of a file rather than of a built-in environment. */
bool environment_is_file(const char *name);

/* Whether the scene has lights of its own that light more than a corner of it. */
bool environment_lights_suffice(const scene *world);

/* Returns the options with a name, and with the strength that suits it: without a name the studio,
 * with a note on stderr, or none. Beside little but suns of the scene's own the studio is as
 * bright as their sky. */
environment_options environment_choose(const environment_options *options, const scene *world);

/* Opens the environment that the options name for a scene. */
bool environment_open(const environment_options *options, const scene *world, environment *e,
                      base_error *error);
void environment_free(environment *e);

static inline bool environment_shines(const environment *e) {
    return e && e->light.rgb;
}

/* Moves small bright parts of a file's image, such as a sun, out of its light and makes hidden caps
 * of them: a few bands would ring, whereas caps are exact and cast shadows. The backdrop keeps
 * these parts. */
bool environment_extract_suns(environment *e, base_error *error);

/* Appends the extracted suns to `count` lights, up to SCENE_LIGHTS_MAX; returns the new count. */
size_t environment_add_suns(const environment *e, scene_light *lights, size_t count);

/* Returns the exposure that suits a scene lit by the studio alone, or by it and faint emissive
 * meshes; else 0: determine one. */
static inline float environment_exposure(const environment *e, size_t light_count) {
    return e && light_count <= e->faint ? e->exposure : 0;
}

/* Whether a scene has shadows by default. It has none where the studio lights a scene that is seen
 * from inside, or through the backs of walls: the studio stands for the light that such a room
 * would have, and the walls would block all of it. */
static inline bool environment_suits_shadows(bool studio, const scene *seen) {
    const scene_frame frame = scene_frame_of(seen);
    return !(studio && (frame.framing == SCENE_FRAMING_INSIDE || frame.sky < 0.1f));
}

/* Projects the environment's light to coefficients, of at least so many bands. */
bool environment_project(environment *e, int bands, base_error *error);

/* Finds where a direction of any length falls on the images, 0 … 1 across and down, by arithmetic
 * whose bits are the same everywhere. */
void environment_place(const environment *e, const float direction[3], float *across, float *down);

/* Returns the backdrop's radiance in a direction of any length, interpolated between pixels;
 * backdrop.glsl does the same. */
lmp_rgb environment_seen(const environment *e, const float direction[3]);

/* Makes the built-in studio and its backdrop: a hemisphere with soft boxes, whose front is the
 * center column. */
bool environment_make_studio(environment *e, base_error *error);
#define STUDIO_IRRADIANCE 4.06f /* of a surface that faces up in it */

/* Resamples a cube map, an unfolded cross of 4 x 3 or 3 x 4 faces, to a latitude-longitude image;
 * *map is created. The middle of the cross is what a camera that looks along -z sees. */
bool environment_unfold(const image *cross, image *map, base_error *error);

#endif
