/* SPDX-License-Identifier: MIT */
/* draco.h - meshes that Draco compressed; the library is C++, and this is its interface to C. */
#ifndef LAMPION_SCENE_GLTF_DRACO_H
#define LAMPION_SCENE_GLTF_DRACO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct draco_mesh draco_mesh;

/* Decodes a mesh; returns NULL if the bytes are not a mesh of Draco's bitstream 2.2, which glTF
 * uses, or memory ran out. */
draco_mesh *draco_mesh_decode(const void *data, size_t size);
void draco_mesh_free(draco_mesh *mesh);

size_t draco_mesh_vertices(const draco_mesh *mesh);
size_t draco_mesh_triangles(const draco_mesh *mesh);

/* Writes the three vertices of each triangle; returns false if a vertex does not exist. */
bool draco_mesh_corners(const draco_mesh *mesh, uint32_t *corners);

/* Writes `width` numbers of each vertex, of the type with that glTF code (5120 …); returns false if
 * the mesh has no such attribute. */
bool draco_mesh_attribute(const draco_mesh *mesh, uint32_t id, int width, int component,
                          void *numbers);

#ifdef __cplusplus
}
#endif

#endif
