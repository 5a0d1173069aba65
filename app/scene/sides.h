/* SPDX-License-Identifier: MIT */
/* sides.h - which side of a body is its front, where neither its format nor its normals say so. */
#ifndef LAMPION_SCENE_SIDES_H
#define LAMPION_SCENE_SIDES_H

#include "app/scene/builder.h"

/* Lets bodies show their fronts outwards that are wound clockwise, with their normals: surfaces
 * that close, or nearly, whether one mesh has them or several whose vertices meet. What they hold
 * decides where it may: a body with bodies of the other winding in it is a room, and one in
 * another of its own mesh a hollow. Where most bodies are clockwise, so is what is open. The
 * meshes are of one space. False without memory. */
bool sides_turn_outwards(scene_builder *builder, const uint32_t *meshes, size_t count);

#endif
