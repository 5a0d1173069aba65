/* SPDX-License-Identifier: MIT */
/* origin.h - the origin of a scene that is read: 0, or a point amid what lies far from there. */
#ifndef LAMPION_SCENE_ORIGIN_H
#define LAMPION_SCENE_ORIGIN_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

/* Appends what a file of these bytes holds to the builder, relative to the builder's origin; the
 * subject of the sources is the file's name. */
typedef bool origin_reader(const void *data, size_t size, source_set *sources,
                           scene_builder *builder, cli_error *error);

/* Reads into an empty builder. The origin is 0, or the middle of a scene that turns out to lie far
 * from there. Such a scene is read once more, and one with vertices far away that nodes bring back:
 * float32 has not the digits to be moved afterwards. */
bool origin_read(origin_reader *read, const void *data, size_t size, source_set *sources,
                 scene_builder *builder, cli_error *error);

#endif
