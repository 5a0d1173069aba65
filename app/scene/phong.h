/* SPDX-License-Identifier: MIT */
/* phong.h - materials of diffuse and Phong lobes as metallic-roughness. */
#ifndef LAMPION_SCENE_PHONG_H
#define LAMPION_SCENE_PHONG_H

#include "app/scene/builder.h"

typedef struct phong {
    float diffuse[3], specular[3], emission[3];
    float exponent, opacity;
} phong;

/* The diffuse color is the base color; the exponent n becomes the roughness whose half
 * vectors have it, n = 2/α² - 2 with α = roughness²; without a specular color it is matte. One much
 * brighter than the diffuse color means metal of that color. Opacity below 1 blends. */
void phong_apply(const phong *from, scene_material *to);

/* Tells by `told` of the materials of meshes whose opacity is 0. Where all would be invisible,
 * opacity means something else than it should: they are opaque, and that is told. False without
 * memory. */
bool phong_tell_invisible(scene_builder *builder, const char *told);

#endif
