/* SPDX-License-Identifier: MIT */
/* animation.h - how lights move: in closed form in time, so that a frame does not depend on the
 * frames before it (docs/lights.md). */
#ifndef LAMPION_SCENE_ANIMATION_H
#define LAMPION_SCENE_ANIMATION_H

#include "app/base/cli.h"
#include "app/scene/scene.h"

typedef struct animation animation;

/* Opens a path by name:
 *
 *     orbit       each light on its own small closed orbit around where it rests, 8 s
 *     bounce      each light falls to the bottom of the scene and comes back, 8 s / a whole number
 *     scene       as the scene file's own animation moves its lights
 *     FILE.json   what the file says
 *
 * A light without a position stays as it is, but that a circle of a file rotates its direction.
 * NULL means scene if the file moves its lights, else orbit. What is needed of the scene is copied.
 * *path is NULL on failure. */
bool animation_open(const char *name, const scene *scene, animation **path, base_error *error);
void animation_close(animation *path);

/* Moves a light to its position after `seconds` >= 0. `number` is its index in the scene; a light
 * that was added later has a greater one, and only orbit and bounce move it. */
void animation_move(const animation *path, size_t number, double seconds, scene_light *light);

/* Moves all lights of the scene to their positions at that time; moved receives light_count of
 * them. */
void animation_move_all(const animation *path, const scene *scene, double seconds,
                        scene_light *moved);

#define ANIMATION_NAMES    "orbit, bounce, scene or FILE.json"
#define ANIMATION_ARGUMENT "orbit|bounce|scene|FILE"

/* The option rows --animate and --fps of an image sequence. */
#define ANIMATION_OPTION_ROWS(path, rate)                                                          \
    { .name = "animate",                                                                           \
      .kind = CLI_TEXT,                                                                            \
      .target = &(path),                                                                           \
      .argument = ANIMATION_ARGUMENT,                                                              \
      .help = "how the lights of --frames move: " ANIMATION_NAMES                                  \
              " (without it, scene if the file moves its lights, else orbit)" },                   \
    {                                                                                              \
        .name = "fps", .kind = CLI_FLOAT, .target = &(rate), .argument = "RATE",                   \
        .help = "frames per second", .minimum = 0.01, .maximum = 1000                              \
    }

#endif
