/* SPDX-License-Identifier: MIT */
/* origin.h - the origin of an imported scene: 0, or a point amid a scene that lies far from
 * there. */
#ifndef LAMPION_SCENE_LOAD_ORIGIN_H
#define LAMPION_SCENE_LOAD_ORIGIN_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

/* Appends the contents of a file to the builder, relative to the builder's origin; the subject of
 * the sources is the file's name. */
typedef bool origin_reader(const void *data, size_t size, source_set *sources,
                           scene_builder *builder, base_error *error);

/* Reads into an empty builder. The origin is 0, or the middle of a scene that turns out to lie far
 * from 0. Such a scene is read again, as is one whose nodes bring back vertices from far away:
 * float32 lacks the digits to move them afterwards. */
bool origin_read(origin_reader *read, const void *data, size_t size, source_set *sources,
                 scene_builder *builder, base_error *error);

#endif
