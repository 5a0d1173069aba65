/* SPDX-License-Identifier: MIT */
/* phong.h - materials with diffuse and Phong lobes as metallic-roughness. */
#ifndef LAMPION_SCENE_PHONG_H
#define LAMPION_SCENE_PHONG_H

#include "app/scene/builder.h"

typedef struct phong {
    float diffuse[3], specular[3], emission[3];
    float exponent, opacity;
} phong;

/* Converts a material: the diffuse color becomes the base color, and the exponent n the roughness
 * whose half vectors have the same exponent, n = 2/α² - 2 with α = roughness²; without a specular
 * color the material is matte. A specular color much brighter than the diffuse one means metal.
 * Opacity below 1 blends. */
void phong_apply(const phong *from, scene_material *to);

/* Reports, in the words `told`, materials of meshes whose opacity is 0. Where all materials would
 * be invisible, the file means something else by opacity: they become opaque, and that is reported.
 * Returns false if memory ran out. */
bool phong_tell_invisible(scene_builder *builder, const char *told);

#endif
