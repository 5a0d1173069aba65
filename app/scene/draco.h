/* SPDX-License-Identifier: MIT */
/* draco.h - meshes as Draco compresses them; the library is C++, and this is all that C sees. */
#ifndef LAMPION_SCENE_DRACO_H
#define LAMPION_SCENE_DRACO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct draco_mesh draco_mesh;

/* NULL if the bytes are no mesh of Draco's bitstream 2.2, which glTF has, or there is no memory. */
draco_mesh *draco_mesh_decode(const void *data, size_t size);
void draco_mesh_free(draco_mesh *mesh);

size_t draco_mesh_vertices(const draco_mesh *mesh);
size_t draco_mesh_triangles(const draco_mesh *mesh);

/* Fills in three vertices of each triangle; false if one is not there. */
bool draco_mesh_corners(const draco_mesh *mesh, uint32_t *corners);

/* Fills in `width` numbers of each vertex, of the type that glTF has that code for (5120 …); false
 * if the mesh has no such attribute. */
bool draco_mesh_attribute(const draco_mesh *mesh, uint32_t id, int width, int component,
                          void *numbers);

#ifdef __cplusplus
}
#endif

#endif
