/* SPDX-License-Identifier: MIT */
/* shadow.h - shadows by the ratio estimator (Heitz, Hill and McGuire 2018): what surfaces reflect
 * has no noise; it is multiplied by the part of it that arrives, which a few rays a pixel and a
 * filter find. docs/shadows.md tells how. */
#ifndef LAMPION_SHADOW_H
#define LAMPION_SHADOW_H

#include "app/render/frame/surfaces.h"
#include "app/trace/trace.h"

typedef struct shadow_settings {
    int rays;      /* per pixel, 1 … SHADOW_RAYS_MAX; 0: as suits */
    uint32_t seed; /* of the noise: the same seed gives the same bits on any number of threads */
    bool raw;      /* without the filter */
    bool sparse;   /* of two neighboring pixels one sends rays */
    bool apart;    /* samples know nothing of those before: all send rays, not one of three */
} shadow_settings;
#define SHADOW_RAYS_MAX    1024
#define SHADOW_RAYS_APART  1 /* of samples that stand alone */
#define SHADOW_RAYS_USUAL  2
#define SHADOW_RAYS_AROUND 4 /* times as many where an environment shines, all half-shadow */

/* What a command line says of shadows. Zero is the default. */
typedef struct shadow_options {
    bool on, off; /* off counts more; neither: as suits */
    bool rays_given;
    shadow_settings settings;
} shadow_options;

/* Whether they are cast in such surroundings of a scene. */
static inline bool shadow_wanted(const shadow_options *options, const environment *surroundings,
                                 const scene *seen) {
    return !options->off && (options->on || environment_suits_shadows(surroundings->studio, seen));
}
#define SHADOW_SUITS "the default, except where the studio lights a scene seen from inside"
#define SHADOW_SWITCH_ROWS(variable, suits)                                                        \
    { .name = "shadows",                                                                           \
      .kind = CLI_FLAG,                                                                            \
      .target = &(variable).on,                                                                    \
      .help = "let surfaces hide lights, by rays on the CPU whatever the device; " suits },        \
    {                                                                                              \
        .name = "no-shadows", .kind = CLI_FLAG, .target = &(variable).off,                         \
        .help = "let no surface hide a light, as in the paper; faster"                             \
    }
#define SHADOW_OPTION_ROWS(variable)                                                               \
    SHADOW_SWITCH_ROWS(variable, SHADOW_SUITS),                                                    \
        { .name = "no-shadow-filter",                                                              \
          .kind = CLI_FLAG,                                                                        \
          .target = &(variable).settings.raw,                                                      \
          .help = "leave the noise of shadows, whose mean over many samples is exact" },           \
        { .name = "shadow-sparse",                                                                 \
          .kind = CLI_FLAG,                                                                        \
          .target = &(variable).settings.sparse,                                                   \
          .help = "rays of shadows from one of two neighboring pixels" },                          \
    {                                                                                              \
        .name = "shadow-rays", .kind = CLI_INT, .target = &(variable).settings.rays,               \
        .argument = "N",                                                                           \
        .help = "rays of shadows for each sample that sends them: the first of a pixel, and "      \
                "every third one after it; without it 2, and 8 where an environment shines",       \
        .minimum = 1, .maximum = SHADOW_RAYS_MAX, .given = &(variable).rays_given                  \
    }

/* Of the last sample that sent rays. */
typedef struct shadow_statistics {
    int rays_a_pixel;
    size_t rays; /* toward lights */
    double rays_milliseconds, filter_milliseconds;
} shadow_statistics;

typedef struct shadow shadow;

/* Scene, its tree and environment, which may be NULL, must outlive it. NULL on failure. */
shadow *shadow_create(const scene *scene, const trace_bvh *bvh, const environment *surroundings,
                      const shadow_settings *settings, cli_error *error);
void shadow_destroy(shadow *shadow);

/* Another environment, or NULL. False without memory: then there is none. */
bool shadow_surround(shadow *shadow, const environment *surroundings, cli_error *error);

/* render_frame.shadow, `user` a shadow. */
bool shadow_frame(void *user, const render_frame *frame, const render_surfaces *surfaces,
                  float *rgba, cli_error *error);

shadow_statistics shadow_describe(const shadow *shadow);

#endif
