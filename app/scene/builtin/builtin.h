/* SPDX-License-Identifier: MIT */
/* builtin.h - scenes made in code. */
#ifndef LAMPION_SCENE_BUILTIN_BUILTIN_H
#define LAMPION_SCENE_BUILTIN_BUILTIN_H

#include "app/scene/builder.h"

/* Parameters of a built-in scene: "builtin:NAME:key=value,…". */
typedef struct builtin_parameters {
    int lanterns, tiles;
    int detail; /* percent */
    uint64_t seed;
} builtin_parameters;

void builtin_atrium(const builtin_parameters *parameters, scene_builder *builder);
void builtin_balls(const builtin_parameters *parameters, scene_builder *builder);
void builtin_ball(const builtin_parameters *parameters, scene_builder *builder);
void builtin_room(const builtin_parameters *parameters, scene_builder *builder);

/* Makes the scene that `name`, the text after "builtin:", asks for. */
bool builtin_make(const char *name, scene_builder *builder, base_error *error);

/* Returns a lantern's color: mostly warm, else one of a few saturated hues; brightest channel 1. */
lmp_rgb builtin_light_color(uint64_t *random, float warm_fraction);

#endif
