/* SPDX-License-Identifier: MIT */
/* mtl.h - materials of an OBJ's MTL file as metallic-roughness. */
#ifndef LAMPION_SCENE_MTL_H
#define LAMPION_SCENE_MTL_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

#include <assimp/scene.h>

/* Appends all materials with their textures. Kd is the base color, times map_Kd; the Phong
 * exponent Ns becomes the roughness whose lobe has that exponent, Ns = 2/α² - 2 with α =
 * roughness²; without Ks, or with illum 0 or 1, it is matte. A Ks much brighter than Kd means metal
 * of that color. Ke is the emission; d below 1 cuts by alpha. */
bool mtl_add_materials(const struct aiScene *imported, source_set *sources, scene_builder *builder,
                       cli_error *error);

#endif
