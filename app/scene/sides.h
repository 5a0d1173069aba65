/* SPDX-License-Identifier: MIT */
/* sides.h - which surfaces are bodies, and which side of a body is its front, if neither its format
 * nor its normals tell. */
#ifndef LAMPION_SCENE_SIDES_H
#define LAMPION_SCENE_SIDES_H

#include "app/scene/builder.h"

/* Flips bodies that are wound clockwise, together with their normals, so that fronts face outwards.
 * A body is a surface that is closed, or nearly so, in one mesh or in several whose vertices meet:
 * of light that starts on its inner side at most an eighth gets out.
 * A clockwise body in which bodies of the other winding stand is a room, and one inside another
 * body of its own mesh is a hollow: both stay. Where most bodies are clockwise, open surfaces are
 * flipped as well. The meshes must share one space. Returns false if memory ran out. */
bool sides_turn_outwards(scene_builder *builder, const uint32_t *meshes, size_t count);

/* How the triangles of a mesh lie. */
typedef enum sides_of {
    SIDES_OPEN,    /* of an open surface */
    SIDES_OUTWARD, /* of a body, the front outside */
    SIDES_INWARD   /* of a body, the front inside */
} sides_of;

/* Finds how each triangle of a mesh lies. Returns false if memory ran out. */
bool sides_find(scene_builder *builder, uint32_t mesh, sides_of *found);

#endif
