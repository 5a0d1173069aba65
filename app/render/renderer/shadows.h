/* SPDX-License-Identifier: MIT */
/* shadows.h - the options of shadows, and the shadows of what a device draws. */
#ifndef LAMPION_RENDER_RENDERER_SHADOWS_H
#define LAMPION_RENDER_RENDERER_SHADOWS_H

#include "app/base/cli.h"
#include "app/render/renderer/renderer.h"
#include "app/render/shadow/shadow.h"
#include "app/scene/environment.h"

/* The shadow options of a command line. Zero is the default. */
typedef struct shadow_options {
    bool on, off; /* off wins; neither: automatic */
    bool rays_given;
    shadow_settings settings;
} shadow_options;

/* Whether a scene in this environment has shadows. */
static inline bool shadow_wanted(const shadow_options *options, const environment *surroundings,
                                 const scene *seen) {
    return !options->off && (options->on || environment_suits_shadows(surroundings->studio, seen));
}
#define SHADOW_SUITS "the default, except where the studio lights the inside of a room"
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
          .help = "leave shadows noisy; the mean of many such samples is exact" },                 \
        { .name = "shadow-sparse",                                                                 \
          .kind = CLI_FLAG,                                                                        \
          .target = &(variable).settings.sparse,                                                   \
          .help = "cast shadow rays from every other pixel alone" },                               \
    {                                                                                              \
        .name = "shadow-rays", .kind = CLI_INT, .target = &(variable).settings.rays,               \
        .argument = "N",                                                                           \
        .help = "shadow rays of each sample that casts any, which are the first of a pixel and "   \
                "every third one after it; without it 2, or 8 where an environment shines",        \
        .minimum = 1, .maximum = SHADOW_RAYS_MAX, .given = &(variable).rays_given                  \
    }

/* Creates the shadows of the device's scene, from the rays of render_device_bvh, as shadow_create
 * does: the device and the environment must outlive them. */
shadow *render_device_shadow(render_device *device, const environment *surroundings,
                             const shadow_settings *settings, base_error *error);

#endif
